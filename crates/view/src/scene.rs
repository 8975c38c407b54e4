//! What is drawn, and the drawing of it.

use crate::camera::{Camera, FOUR_SIDES};
use crate::raster::Canvas;
use crate::{Image, Rgb, View};
use glam::DVec3;
use mesh_core::{FaceId, IdVec, TriMesh};

/// A mesh with what lies on it.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// The mesh.
    pub mesh: &'a TriMesh,
    /// A colour for every face; light grey without. Faces beyond its end are light grey.
    pub face_colors: Option<IdVec<FaceId, Rgb>>,
    /// Lines, hidden by what is in front of them. A line on the surface is seen.
    pub lines: Vec<Line>,
    /// Round dots, hidden like lines.
    pub points: Vec<Point>,
}

impl<'a> Scene<'a> {
    /// The mesh alone, light grey.
    pub fn new(mesh: &'a TriMesh) -> Self {
        Self { mesh, face_colors: None, lines: Vec::new(), points: Vec::new() }
    }
}

/// A straight line in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// One end.
    pub from: DVec3,
    /// The other end.
    pub to: DVec3,
    /// Its colour.
    pub color: Rgb,
    /// Its width in pixels.
    pub width: f64,
}

/// A round dot in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Where.
    pub at: DVec3,
    /// Its colour.
    pub color: Rgb,
    /// Its diameter in pixels.
    pub width: f64,
}

/// How a scene is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewOptions {
    /// Width of the picture in pixels. Default 1400.
    pub width: usize,
    /// Height of the picture in pixels. Default 1400.
    pub height: usize,
    /// From where. Default: four views on one sheet.
    pub view: View,
    /// Draw the edges of all triangles as thin dark lines. Default off.
    pub edges: bool,
}

impl Default for ViewOptions {
    fn default() -> Self {
        Self { width: 1400, height: 1400, view: View::Four, edges: false }
    }
}

/// Samples per pixel in each direction.
const SUPERSAMPLING: usize = 2;
/// Colour of faces without one.
const PLAIN: Rgb = [205, 208, 212];

/// Draws a scene on white: faces of both sides lit from the camera, lines and points on top of the surface they lie on.
pub fn render(scene: &Scene, options: &ViewOptions) -> Image {
    let (width, height) = (options.width, options.height);
    let (w, h) = (SUPERSAMPLING * width, SUPERSAMPLING * height);
    match options.view {
        View::From(side) => draw(scene, &Camera::fit(&shown_points(scene), side, w, h), (w, h), options.edges),
        View::Close { at, radius, from } => draw(scene, &Camera::close(at, radius, from, w, h), (w, h), options.edges),
        View::Four => {
            let points = shown_points(scene);
            let mut sheet = Image::white(width, height);
            for (i, side) in FOUR_SIDES.into_iter().enumerate() {
                let tile = draw(scene, &Camera::fit(&points, side, w / 2, h / 2), (w / 2, h / 2), options.edges);
                sheet.paste(&tile, i % 2 * (width / 2), i / 2 * (height / 2));
            }
            sheet
        }
    }
}

/// Every point that has to be in the picture.
fn shown_points(scene: &Scene) -> Vec<DVec3> {
    let corners = scene.mesh.faces().iter().flatten().map(|&v| scene.mesh.position(v));
    let ends = scene.lines.iter().flat_map(|l| [l.from, l.to]);
    corners.chain(ends).chain(scene.points.iter().map(|p| p.at)).collect()
}

/// Draws into a canvas of `size` samples and halves it to pixels.
fn draw(scene: &Scene, camera: &Camera, size: (usize, usize), edges: bool) -> Image {
    let mut canvas = Canvas::white(size.0, size.1);
    let samples = SUPERSAMPLING as f64;
    for (f, corners) in scene.mesh.faces().enumerate() {
        let color = scene.face_colors.as_ref().and_then(|c| c.get(f).copied()).unwrap_or(PLAIN);
        let shade = lit(color, scene.mesh.normal(f).dot(camera.back));
        canvas.triangle(corners.map(|v| camera.project(scene.mesh.position(v))), shade, edges);
    }
    for line in &scene.lines {
        canvas.line(camera.project(line.from), camera.project(line.to), samples * line.width, line.color);
    }
    for point in &scene.points {
        let at = camera.project(point.at);
        canvas.line(at, at, samples * point.width, point.color);
    }
    canvas.into_image().halved()
}

/// Lambert's law with the light at the camera, the same on both sides, over some ambient light.
fn lit(color: Rgb, cosine: f64) -> Rgb {
    const AMBIENT: f64 = 0.40;
    let light = AMBIENT + (1.0 - AMBIENT) * cosine.abs();
    color.map(|c| (f64::from(c) * light).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cube -1..1, two triangles a side.
    fn cube() -> TriMesh {
        let corner = |i: usize| DVec3::from_array([0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 1.0 } else { -1.0 }));
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces = quads.iter().flat_map(|&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]]).collect();
        TriMesh::new((0..8).map(corner).collect(), faces).unwrap()
    }

    fn from_x(edges: bool) -> ViewOptions {
        ViewOptions { width: 100, height: 100, view: View::From(DVec3::X), edges }
    }

    #[test]
    fn a_cube_shows_three_shades_where_expected() {
        let mesh = cube();
        let from = DVec3::new(3.0, 1.0, 2.0);
        let camera = Camera::fit(mesh.positions().as_slice(), from, 200, 200);
        let options = ViewOptions { width: 200, height: 200, view: View::From(from), edges: false };
        let image = render(&Scene::new(&mesh), &options);
        let mut shades = Vec::new();
        for side in [DVec3::X, DVec3::Y, DVec3::Z] {
            let p = camera.project(side);
            let shade = image.pixel(p.x as usize, p.y as usize);
            assert_eq!(shade, lit(PLAIN, side.dot(from.normalize())));
            shades.push(shade);
        }
        assert!(shades[0] > shades[2] && shades[2] > shades[1]);
        assert_eq!(image.pixel(0, 0), [255; 3]);
    }

    #[test]
    fn only_the_line_in_front_is_seen() {
        let mesh = cube();
        let mut scene = Scene::new(&mesh);
        let across = |x, color| Line { from: DVec3::new(x, -0.8, 0.0), to: DVec3::new(x, 0.8, 0.0), color, width: 4.0 };
        scene.lines = vec![across(1.0, [255, 0, 0]), across(-1.0, [0, 0, 255])];
        let image = render(&scene, &from_x(false));
        assert_eq!(image.pixel(50, 50), [255, 0, 0], "a line on the near side");
        scene.lines.remove(0);
        assert_eq!(render(&scene, &from_x(false)), render(&Scene::new(&mesh), &from_x(false)), "a line on the far side");
    }

    #[test]
    fn points_are_drawn_where_they_are() {
        let mesh = cube();
        let mut scene = Scene::new(&mesh);
        scene.points = vec![Point { at: DVec3::new(1.0, 0.0, 0.5), color: [0, 200, 0], width: 6.0 }];
        let image = render(&scene, &from_x(false));
        assert_eq!(image.pixel(50, 26), [0, 200, 0]);
        assert_eq!(image.pixel(50, 50), lit(PLAIN, 1.0));
    }

    #[test]
    fn edges_are_darker_than_faces() {
        let mesh = cube();
        let image = render(&Scene::new(&mesh), &from_x(true));
        let darkest = (3..97).map(|x| image.pixel(x, 30)[0]).min().unwrap();
        assert!(darkest < 180, "the diagonal of the near side: {darkest}");
        assert_eq!(render(&Scene::new(&mesh), &from_x(false)).pixel(50, 50), lit(PLAIN, 1.0));
    }

    #[test]
    fn an_empty_mesh_is_white() {
        let mesh = TriMesh::new(vec![], vec![]).unwrap();
        let options = ViewOptions { width: 31, height: 17, ..ViewOptions::default() };
        assert_eq!(render(&Scene::new(&mesh), &options), Image::white(31, 17));
    }

    #[test]
    fn a_close_view_deep_inside_a_face_is_all_face() {
        let mesh = cube();
        let view = crate::close_up(&mesh, DVec3::new(1.0, 0.3, -0.6), 1e-6);
        let image = render(&Scene::new(&mesh), &ViewOptions { width: 20, height: 10, view, edges: true });
        assert!((0..20).all(|x| (0..10).all(|y| image.pixel(x, y) == lit(PLAIN, 1.0))));
    }
}
