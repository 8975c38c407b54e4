//! What a file has beside positions: what it marks, and what comes out of it.

use super::Story;

/// A square of two materials that part at its diagonal, with texture coordinates that jump there.
const PAINTED: &str = "mtllib colours.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 5 5\nvt 6 6\nvt 5 6\n\
                       usemtl red\nf 1/1 2/2 3/3\nusemtl blue\nf 1/4 3/5 4/6\n";
const SMALL: &str = "--base-vertices 30 --levels 1";

impl Story {
    fn text(&self, name: &str) -> String {
        String::from_utf8(self.bytes(name)).expect("UTF-8")
    }
    /// Lines that begin with a keyword.
    fn count(&self, name: &str, keyword: &str) -> usize {
        self.text(name).lines().filter(|line| line.split(' ').next() == Some(keyword)).count()
    }
}

#[test]
fn without_creases_only_borders_are_kept() {
    let story = Story::new();
    story.done(&format!("remesh @cube.obj -o sharp.obj {SMALL}"));
    assert!(story.count("sharp.obj", "l") >= 24 && story.count("sharp.obj", "vn") > story.count("sharp.obj", "v"));
    story.done(&format!("remesh @cube.obj -o none.obj {SMALL} --features none"));
    story.done(&format!("remesh @cube.obj -o flat.obj {SMALL} --crease-angle 180"));
    assert_eq!((story.count("none.obj", "l"), story.count("none.obj", "vn")), (0, story.count("none.obj", "v")));
    assert!(story.bytes("none.obj") == story.bytes("flat.obj"));
    story.done("check none.obj --levels 1");
}

#[test]
fn normals_of_a_file_make_its_edges_hard() {
    let story = Story::new();
    // The normals of this result change at the edges of the cube alone.
    story.done(&format!("remesh @cube.obj -o sharp.obj {SMALL}"));
    story.done(&format!("remesh sharp.obj -o again.ply {SMALL} --features normals"));
    story.done(&format!("remesh sharp.obj -o again.obj {SMALL} --features normals"));
    assert!(story.count("again.obj", "l") >= 24 && story.count("again.obj", "vn") > story.count("again.obj", "v"));
    story.refused(&format!("remesh @cube.obj -o out.obj {SMALL} --features normals"), "has no normals or smoothing groups");
    story.write("groups.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ns 1\nf 1 2 3\ns 2\nf 1 3 4\n");
    story.done(&format!("remesh groups.obj -o groups_out.obj {SMALL} --features normals"));
    assert!(story.count("groups_out.obj", "l") >= 2);
}

#[test]
fn seams_and_materials_are_kept_on_request() {
    let story = Story::new();
    story.write("in.obj", PAINTED);
    for what in ["seams", "materials", "seams,materials"] {
        story.done(&format!("remesh in.obj -o out.obj {SMALL} --keep {what}"));
        story.done("check out.obj --levels 1");
        assert!(story.count("out.obj", "l") >= 2, "{what}");
        // Values on both sides of the diagonal, and one normal: the square is flat.
        let on_diagonal = story.count("out.obj", "l") + 1;
        assert_eq!(story.count("out.obj", "vt"), story.count("out.obj", "v") + on_diagonal);
        assert_eq!(story.count("out.obj", "vn"), story.count("out.obj", "v"));
        let text = story.text("out.obj");
        assert!(text.starts_with("mtllib colours.mtl\n") && text.contains("usemtl red\n") && text.contains("usemtl blue\n"));
    }
    story.refused(
        &format!("remesh @cube.obj -o out.obj {SMALL} --keep seams"),
        "has no texture coordinates; leave --keep seams out",
    );
    story.refused(&format!("remesh @cube.obj -o out.obj {SMALL} --keep materials"), "has no materials");
}

#[test]
fn a_plain_output_has_positions_and_triangles_alone() {
    let story = Story::new();
    story.write("in.obj", PAINTED);
    story.done(&format!("remesh in.obj -o out.obj {SMALL} --keep seams --plain"));
    let text = story.text("out.obj");
    assert!(text.lines().all(|line| line.starts_with("v ") || line.starts_with("f ")));
}

#[test]
fn labels_and_values_of_a_ply_come_out() {
    let story = Story::new();
    let header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float heat\n\
                  element face 2\nproperty list uchar int vertex_indices\nproperty int part\nend_header\n";
    story.write("in.ply", &format!("{header}0 0 0 0\n1 0 0 1\n1 1 0 2\n0 1 0 1\n3 0 1 2 7\n3 0 2 3 9\n"));
    let report = story.json(&format!("remesh in.ply -o out.ply {SMALL} --json"));
    assert_eq!(report["warnings"], serde_json::json!([]));
    let out = String::from_utf8_lossy(&story.bytes("out.ply")).into_owned();
    assert!(out.contains("property float heat\n") && out.contains("property int part\n"));
    let report = story.json(&format!("remesh in.ply -o out.glb {SMALL} --json"));
    assert_eq!(report["warnings"], serde_json::json!(["the properties part are not carried over to the result"]));
}

#[test]
fn angles_without_creases_have_no_meaning() {
    let story = Story::new();
    let ended = story.run("remesh @cube.obj -o out.obj --features none --crease-angle 30");
    assert!(
        ended.code == Some(2) && ended.stderr.contains("--crease-angle has no meaning with --features none"),
        "{}",
        ended.stderr
    );
}
