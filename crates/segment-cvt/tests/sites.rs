//! Numbers and places of the sites on shapes of every kind.

use glam::DVec3;
use mesh_core::{FaceId, Id, IdVec, SurfacePoint, Topology, TriMesh};
use region_map::{ArcKind, Cells, Network, PatchId, Segmentation, Sites, Sizing, Surface};
use segment_cvt::{CvtError, CvtOptions, Sampled, sample};
use segment_vsa::{VsaOptions, segment};

/// A surface with the cells of a segmentation.
struct Patched {
    surface: Surface,
    cells: Cells,
}

impl Patched {
    fn new(surface: Surface, segmentation: &Segmentation) -> Self {
        let cells = Cells::trace(&surface, segmentation).unwrap();
        Self { surface, cells }
    }

    /// A mesh with arcs at borders and at edges of more than 40 degrees, and a patch for every face.
    fn by_face(mesh: TriMesh, patch: impl Fn(&TriMesh, FaceId) -> PatchId) -> Self {
        let segmentation = by_face(&mesh, patch);
        Self::new(creased(mesh), &segmentation)
    }

    /// Patches by variational shape approximation.
    fn vsa(mesh: TriMesh) -> Self {
        let surface = creased(mesh);
        let (segmentation, _) = segment(&surface, &VsaOptions { max_patches: 12, ..VsaOptions::default() }).unwrap();
        Self::new(surface, &segmentation)
    }

    /// One patch a sheet; all must be disks.
    fn sheets(mesh: TriMesh) -> Self {
        let surface = creased(mesh);
        let network = surface.network();
        let patch_of_face = network.sheet_of_face.iter().map(|s| PatchId(s.0)).collect();
        let segmentation = Segmentation { patch_of_face, n_patches: network.n_sheets };
        Self::new(surface, &segmentation)
    }

    /// One patch whose border vertices are all corners.
    fn polygon(mesh: TriMesh) -> Self {
        let topology = Topology::new(mesh.faces(), mesh.n_vertices()).unwrap();
        let kinds = ArcKind::by_angle(&mesh, &topology, 40.0);
        let network = Network::trace(&mesh, &topology, &kinds, |_| true, Vec::new()).unwrap();
        let segmentation = by_face(&mesh, |_, _| PatchId(0));
        Self::new(Surface::new(mesh, topology, network).unwrap(), &segmentation)
    }

    /// Patches by octant.
    fn octants(mesh: TriMesh) -> Self {
        Self::by_face(mesh, |mesh, f| {
            let p = mesh.centroid(f);
            PatchId::new(usize::from(p.x > 0.0) + 2 * usize::from(p.y > 0.0) + 4 * usize::from(p.z > 0.0))
        })
    }

    fn sample(&self, sizing: &Sizing, base_vertices: usize) -> Sampled {
        sample(&self.surface, &self.cells, sizing, &options(base_vertices)).unwrap()
    }

    fn uniform(&self, base_vertices: usize) -> Sampled {
        self.sample(&Sizing::uniform(self.surface.mesh()), base_vertices)
    }

    fn n_sites(&self, sites: &Sites) -> usize {
        let on_arcs = sites.on_arcs.iter().map(Vec::len).sum::<usize>();
        self.cells.corners.len() + on_arcs + sites.in_patches.iter().map(Vec::len).sum::<usize>()
    }

    /// Positions of corners, arc sites and patch sites.
    fn positions(&self, sites: &Sites) -> Vec<DVec3> {
        let (mesh, cells) = (self.surface.mesh(), &self.cells);
        let corners = cells.corners.iter().map(|&v| mesh.position(v));
        let on_arcs = sites.on_arcs.enumerate().flat_map(|(a, ts)| ts.iter().map(move |&t| cells.arcs[a].position(mesh, t)));
        let inner = sites.in_patches.iter().flatten().map(|p| p.position(mesh));
        corners.chain(on_arcs).chain(inner).collect()
    }

    /// Mean and least distance of a site to its nearest neighbour.
    fn spacing(&self, sampled: &Sampled) -> [f64; 2] {
        let gaps = gaps(&self.positions(&sampled.sites));
        [gaps.iter().sum::<f64>() / gaps.len() as f64, gaps.into_iter().fold(f64::INFINITY, f64::min)]
    }
}

fn creased(mesh: TriMesh) -> Surface {
    Surface::with_creases(mesh, 40.0).unwrap()
}

/// A segmentation by a patch for every face.
fn by_face(mesh: &TriMesh, patch: impl Fn(&TriMesh, FaceId) -> PatchId) -> Segmentation {
    let patch_of_face: IdVec<FaceId, PatchId> = mesh.faces().ids().map(|f| patch(mesh, f)).collect();
    let n_patches = patch_of_face.iter().map(|p| p.index() + 1).max().unwrap_or(0);
    Segmentation { patch_of_face, n_patches }
}

fn options(base_vertices: usize) -> CvtOptions {
    CvtOptions { base_vertices, ..CvtOptions::default() }
}

/// The distance of every position from the nearest other one.
fn gaps(positions: &[DVec3]) -> Vec<f64> {
    let gap = |i: usize| {
        let others = positions.iter().enumerate().filter(|o| o.0 != i);
        others.map(|(_, q)| q.distance(positions[i])).fold(f64::INFINITY, f64::min)
    };
    (0..positions.len()).map(gap).collect()
}

#[test]
fn the_count_is_the_request_or_what_the_topology_needs() {
    let shapes = [
        ("plane", Patched::vsa(fixtures::plane())),
        ("box of twelve", Patched::vsa(fixtures::cube(1))),
        ("cube", Patched::vsa(fixtures::cube(4))),
        ("L", Patched::vsa(fixtures::l_block(3))),
        ("two boxes", Patched::vsa(fixtures::crossing_boxes(2))),
        ("cylinder", Patched::vsa(fixtures::cylinder(0.5, 1.5, 24))),
        ("cone", Patched::vsa(fixtures::cone(1.0, 1.0, 24))),
        ("sphere", Patched::vsa(fixtures::icosphere(6))),
        ("torus", Patched::vsa(fixtures::torus(1.0, 0.4, 24, 16))),
        ("shell", Patched::vsa(fixtures::shell(16))),
        ("part", Patched::vsa(fixtures::part(6))),
    ];
    for (name, shape) in shapes {
        let cells = &shape.cells;
        let least = cells.least_segments();
        let needed = cells.corners.len() + least.iter().map(|k| k - 1).sum::<usize>();
        for wanted in [0, 1, 4, 10, 23, 50, 77, 100, 101, 137, 200, 333] {
            let Sampled { sites, budget } = shape.uniform(wanted);
            assert_eq!(budget.needed, needed, "{name}");
            assert_eq!(budget.total, wanted.max(needed), "{name} {wanted}");
            assert_eq!(shape.n_sites(&sites), budget.total, "{name} {wanted}");
            for (arc, ts) in sites.on_arcs.enumerate() {
                assert_eq!(ts.len() + 1, budget.segments[arc], "{name} {wanted}");
                assert!(budget.segments[arc] >= least[arc], "{name} {wanted}");
            }
            for (p, inner) in sites.in_patches.enumerate() {
                assert_eq!(inner.len(), budget.inner[p], "{name} {wanted}");
                assert!(inner.iter().all(|s| cells.patches[p].faces.binary_search(&s.face).is_ok()), "{name} {wanted}");
            }
            assert!(gaps(&shape.positions(&sites)).iter().all(|&g| g > 0.0), "{name} {wanted}");
        }
    }
}

#[test]
fn the_count_is_met_where_equal_arcs_change_at_once() {
    // A cross of five unit squares, one patch with twelve sides of length 1: their numbers go up together, and the patch takes up
    // all that is then missing.
    let columns = [(1, 0), (2, 0), (0, 1), (1, 1), (2, 1), (3, 1), (0, 2), (1, 2), (2, 2), (3, 2), (1, 3), (2, 3)];
    let positions = columns.map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0)).to_vec();
    let squares = [[0, 1, 4, 3], [2, 3, 7, 6], [3, 4, 8, 7], [4, 5, 9, 8], [7, 8, 11, 10]];
    let faces = squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let cross = Patched::polygon(TriMesh::new(positions, faces).unwrap());
    assert_eq!(cross.cells.arcs.len(), 12);
    for wanted in 12..200 {
        let Sampled { sites, budget } = cross.uniform(wanted);
        assert_eq!((budget.total, cross.n_sites(&sites)), (wanted, wanted));
    }
}

#[test]
fn closed_arcs_get_three_segments_and_parallel_ones_two() {
    let sphere = fixtures::uv_sphere(24);
    let by = |patch: fn(DVec3) -> u32| Patched::by_face(sphere.clone(), |mesh, f| PatchId(patch(mesh.centroid(f))));
    let Sampled { budget, .. } = by(|p| u32::from(p.z > 0.0)).uniform(0);
    assert_eq!((budget.segments.as_slice(), budget.needed), (&[3][..], 3));
    let Sampled { budget, .. } = by(|p| u32::from(p.x > 0.0) + 2 * u32::from(p.y > 0.0)).uniform(0);
    assert_eq!((budget.segments.as_slice(), budget.needed), (&[2; 4][..], 6));
}

#[test]
fn sites_cut_arcs_evenly() {
    let cylinder = Patched::vsa(fixtures::cylinder(0.5, 1.5, 30));
    let cells = &cylinder.cells;
    let Sampled { sites, budget } = cylinder.uniform(90);
    assert!(budget.segments.iter().any(|&k| k > 3));
    for (id, ts) in sites.on_arcs.enumerate() {
        let arc = &cells.arcs[id];
        for (i, t) in ts.iter().enumerate() {
            let expected = arc.length() * (i + 1) as f64 / budget.segments[id] as f64;
            assert!((t - expected).abs() < 1e-12 * arc.length());
        }
        // Rounded to the edge length of the budget, where the topology leaves a choice.
        let exact = arc.length() / budget.edge_length;
        assert!((budget.segments[id] as f64 - exact).abs() <= 0.5 || exact < 3.5);
    }
}

#[test]
fn a_plane_of_two_triangles_is_filled_evenly() {
    let plane = Patched::sheets(fixtures::plane());
    for wanted in [40, 100, 250] {
        let Sampled { sites, budget } = plane.uniform(wanted);
        let positions = plane.positions(&sites);
        let h = budget.edge_length;
        let inner = sites.in_patches.iter().map(Vec::len).sum::<usize>();
        assert!(gaps(&positions)[wanted - inner..].iter().all(|&g| g > 0.6 * h && g < 1.4 * h), "{wanted}");
        for (x, y) in (0..=50).flat_map(|i| (0..=30).map(move |j| (2.0 * f64::from(i), 2.0 * f64::from(j)))) {
            let gap = positions.iter().map(|p| p.distance(DVec3::new(x, y, 0.0))).fold(f64::INFINITY, f64::min);
            assert!(gap < 0.95 * h, "{wanted}: nothing within {gap} of {x}, {y}");
        }
    }
}

/// A rectangle of 100 by 60 in three strips of two triangles, with a relative edge length on each of the lines x = 0, 40, 50, 100.
fn strips(relative: [f64; 4]) -> (TriMesh, Sizing) {
    let position = |i: usize| DVec3::new([0.0, 40.0, 50.0, 100.0][i / 2], 60.0 * (i % 2) as f64, 0.0);
    let faces = [0, 2, 4].into_iter().flat_map(|i| [[i, i + 2, i + 3], [i, i + 3, i + 1]]).collect();
    let mesh = TriMesh::new((0..8).map(position).collect(), faces).unwrap();
    (mesh, Sizing { relative: (0..8).map(|i| relative[i / 2]).collect() })
}

#[test]
fn the_sizing_field_halves_the_spacing_where_it_asks_for_it() {
    let (mesh, sizing) = strips([0.5, 0.5, 1.0, 1.0]);
    let strips = Patched::sheets(mesh);
    let Sampled { sites, budget } = strips.sample(&sizing, 400);
    assert_eq!(budget.total, 400);
    let positions = strips.positions(&sites);
    let mean_gap = |from: f64, to: f64| {
        let here: Vec<f64> =
            positions.iter().zip(gaps(&positions)).filter(|(p, _)| p.x > from && p.x < to).map(|(_, gap)| gap).collect();
        assert!(here.len() > 20);
        here.iter().sum::<f64>() / here.len() as f64
    };
    let ratio = mean_gap(0.0, 38.0) / mean_gap(55.0, 100.0);
    assert!((ratio - 0.5).abs() < 0.06, "{ratio}");
    // On the borders too: the sites of the lower border, left and right of x = 38 and x = 55.
    let lower =
        |from: f64, to: f64| positions.iter().filter(|p| p.y == 0.0 && p.x > from && p.x < to).count() as f64 / (to - from);
    assert!((lower(0.0, 38.0) / lower(55.0, 100.0) - 2.0).abs() < 0.5);
}

#[test]
fn steps_follow_the_field_along_one_long_edge() {
    // Every side of the rectangles is an arc of one edge; on two of length 50 the relative length falls from 1 to 1/3.
    let (mesh, sizing) = strips([1.0, 1.0, 1.0, 1.0 / 3.0]);
    let strips = Patched::polygon(mesh);
    let cells = &strips.cells;
    let Sampled { sites, budget } = strips.sample(&sizing, 900);
    let falling: Vec<_> = cells.arcs.ids().filter(|&a| cells.arcs[a].length() == 50.0).collect();
    assert_eq!(falling.len(), 2);
    for a in falling {
        let arc = &cells.arcs[a];
        let stops: Vec<f64> = [0.0].into_iter().chain(sites.on_arcs[a].iter().copied()).chain([50.0]).collect();
        let relative = |t: f64| 1.0 - (arc.position(strips.surface.mesh(), t).x - 50.0) / 75.0;
        let ratios: Vec<f64> = stops.windows(2).map(|t| (t[1] - t[0]) / relative(t[0].midpoint(t[1]))).collect();
        assert!(ratios.len() == budget.segments[a] && ratios.len() > 15);
        assert!(ratios.iter().all(|r| (r / ratios[0] - 1.0).abs() < 0.01), "{ratios:?}");
    }
}

#[test]
fn only_ratios_of_the_sizing_field_matter() {
    let (mesh, mut sizing) = strips([0.5, 1.0, 0.25, 1.0]);
    let strips = Patched::sheets(mesh);
    let expected = strips.sample(&sizing, 150);
    // A power of two: nothing is rounded.
    let scale = 2f64.powi(-30);
    sizing.relative.iter_mut().for_each(|h| *h *= scale);
    let scaled = strips.sample(&sizing, 150);
    assert_eq!(scaled.sites, expected.sites);
    assert!((scaled.budget.edge_length * scale / expected.budget.edge_length - 1.0).abs() < 1e-12);
}

#[test]
fn sites_are_the_same_on_any_number_of_threads() {
    let part = Patched::vsa(fixtures::part(6));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| part.uniform(150))
    };
    assert_eq!(on(1), on(2));
}

#[test]
fn other_numbers_and_seeds_give_sites_as_good() {
    let mesh = fixtures::uv_sphere(32);
    let sphere = Patched::octants(mesh.clone());
    let first = sphere.uniform(120);
    let [mean, least] = sphere.spacing(&first);

    let mut faces: Vec<_> = mesh.faces().iter().map(|f| f.map(|v| v.0)).collect();
    faces.reverse();
    let renumbered = Patched::octants(TriMesh::new(mesh.positions().as_slice().to_vec(), faces).unwrap());
    let second = renumbered.uniform(120);
    let other_seed = CvtOptions { seed: 7, ..options(120) };
    let reseeded = sample(&sphere.surface, &sphere.cells, &Sizing::uniform(&mesh), &other_seed).unwrap();
    assert_ne!(first.sites, reseeded.sites);
    for (shape, other) in [(&renumbered, &second), (&sphere, &reseeded)] {
        let [other_mean, other_least] = shape.spacing(other);
        assert!((other_mean / mean - 1.0).abs() < 0.05, "{mean} {other_mean}");
        assert!((other_least / least - 1.0).abs() < 0.3, "{least} {other_least}");
    }
}

#[test]
fn a_surface_without_area_is_refused_and_faces_without_area_are_passed_over() {
    let line = TriMesh::new(vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X], vec![[0, 1, 2]]).unwrap();
    let uniform = Sizing::uniform(&line);
    let line = Patched::sheets(line);
    let refused = sample(&line.surface, &line.cells, &uniform, &options(10));
    assert_eq!(refused.unwrap_err(), CvtError::NoArea);

    // A square whose diagonal is a needle.
    let corners = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y, DVec3::new(0.5, 0.5, 0.0)];
    let mesh = TriMesh::new(corners, vec![[0, 1, 4], [1, 2, 4], [0, 4, 2], [0, 2, 3]]).unwrap();
    let square = Patched::by_face(mesh.clone(), |_, _| PatchId(0));
    let Sampled { sites, budget } = square.uniform(30);
    assert_eq!(square.n_sites(&sites), 30);
    assert_eq!(budget.total, 30);
    let on_needle = |s: &SurfacePoint| s.face.index() == 2;
    assert!(sites.in_patches.iter().flatten().all(|s| !on_needle(s) && s.position(&mesh).is_finite()));
}
