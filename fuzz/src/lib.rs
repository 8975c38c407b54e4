//! What must hold for any bytes, whatever format they are read as: no panic, no hang, no memory without bound. libFuzzer watches
//! over all three (`-timeout`, `-rss_limit_mb`). The tests of `mesh-io` ask the same of broken files.

use mesh_core::{CleanOptions, Soup, clean, inspect};
use mesh_io::{Document, Format, read_bytes};

/// Triangles up to which a document that was read is also inspected and cleaned, so that an input stays quick.
const MOST_TRIANGLES: usize = 2000;

/// Reads the bytes, and takes what they say through inspection and cleaning.
pub fn check(bytes: &[u8], format: Format) {
    let Ok(document) = read_bytes(bytes, format) else { return };
    check_document(&document);
    if document.soup.triangles.len() <= MOST_TRIANGLES {
        let _ = inspect(&document.soup);
        for weld_tolerance in [CleanOptions::default().weld_tolerance, 1e-3] {
            check_cleaning(&document.soup, &CleanOptions { weld_tolerance, ..CleanOptions::default() });
        }
    }
}

/// A document's lists agree with each other.
fn check_document(document: &Document) {
    assert_eq!(document.polygon_of.len(), document.soup.triangles.len());
    assert!(document.extras.windows(2).all(|pair| pair[0] < pair[1]), "each kind once");
    assert!(document.polygon_of.is_sorted() && document.polygon_of.iter().all(|&p| (p as usize) < document.n_polygons));
}

/// What was cleaned is an oriented manifold: `clean` itself fails with `Broken...` otherwise, which is a fault of ours.
fn check_cleaning(soup: &Soup, options: &CleanOptions) {
    match clean(soup, options) {
        Ok(cleaned) => {
            assert_eq!(cleaned.source_face.len(), cleaned.mesh.n_faces());
            let after = inspect(&cleaned.mesh.to_soup());
            assert_eq!((after.bad_index, after.not_finite), (0, 0));
        }
        Err(e) => assert!(matches!(e, mesh_core::CleanError::NothingLeft { .. }), "{e}"),
    }
}
