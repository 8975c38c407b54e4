//! Remeshing that goes well.

use super::Story;

const CUBE: &str = "--base-vertices 50 --levels 1";

#[test]
fn every_format_is_written_and_checks() {
    let story = Story::new();
    for format in ["obj", "ply", "off", "gltf", "glb"] {
        story.done(&format!("remesh @cube.obj -o out.{format} {CUBE}"));
        story.done(&format!("check out.{format} --levels 1"));
    }
    // stl has no vertices of its own, so their order is lost, but the surface is there.
    story.done(&format!("remesh @cube.obj -o out.stl {CUBE}"));
    assert!(story.json("compare @cube.obj out.stl --json")["err_max"].as_f64().is_some_and(|e| e < 1e-6));
    assert_eq!(story.files().len(), 6, "nothing else is left: {:?}", story.files());
}

#[test]
fn every_format_is_read() {
    let story = Story::new();
    for input in ["plane.off", "cylinder.ply", "l_block.obj"] {
        story.done(&format!("remesh @{input} -o out.obj {CUBE}"));
        story.done("check out.obj --levels 1");
    }
    story.done(&format!("remesh @cube.obj -o cube.glb {CUBE}"));
    story.done(&format!("remesh cube.glb -o again.obj {CUBE}"));
}

#[test]
fn the_json_has_what_the_contract_names() {
    let story = Story::new();
    let report = story.json(&format!("remesh @cube.obj -o out.obj {CUBE} --seed 7 --json"));
    for key in ["version", "parameters", "seed", "repairs", "warnings", "base_vertices", "seconds", "topology"] {
        assert!(!report[key].is_null(), "{key}");
    }
    for key in ["ar_mean", "ar_p01", "agl", "area_cv", "err_mean", "err_rms", "err_max", "crease_cover"] {
        assert!(report[key].is_number(), "{key}");
    }
    for key in ["asked", "needed", "made"] {
        assert!(report["base_vertices"][key].is_u64(), "{key}");
    }
    assert_eq!((&report["flipped"], &report["degenerate"]), (&0.into(), &0.into()));
    assert_eq!((&report["seed"], &report["parameters"]["levels"]), (&7.into(), &1.into()));
    assert!(report["seconds"].as_object().is_some_and(|s| s.contains_key("relax") && s.values().all(|t| t.is_number())));
    // V_n = 4^n (V_0 - X) + X and F_n = 4^n F_0 of a closed surface.
    let made = report["base_vertices"]["made"].as_u64().unwrap();
    assert_eq!(report["vertices"], 4 * (made - 2) + 2);
    assert_eq!(report["faces"], 4 * (2 * made - 4));
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let story = Story::new();
    for threads in [1, 2, 5] {
        story.done(&format!("remesh @cylinder.ply -o out{threads}.obj {CUBE} --threads {threads}"));
    }
    assert!(story.bytes("out1.obj") == story.bytes("out2.obj"));
    assert!(story.bytes("out1.obj") == story.bytes("out5.obj"));
}

#[test]
fn stages_leave_pictures_and_meshes() {
    let story = Story::new();
    story.done(&format!("remesh @cube.obj -o out.obj {CUBE} --stages a/b"));
    for stage in [
        "01-input",
        "02-features",
        "03-patches",
        "04-sites",
        "05-base",
        "06-subdivided",
        "07-projected",
        "08-result",
        "09-distance",
    ] {
        assert!(story.bytes(&format!("a/b/{stage}.png")).starts_with(b"\x89PNG"), "{stage}");
        story.done(&format!("inspect a/b/{stage}.ply"));
    }
    assert_eq!(story.done("check a/b/08-result.ply --levels 1"), story.done("check out.obj --levels 1"));
}

#[test]
fn an_old_result_is_replaced() {
    let story = Story::new();
    story.write("out.obj", "old");
    story.done(&format!("remesh @cube.obj -o out.obj {CUBE}"));
    story.done("check out.obj --levels 1");
}
