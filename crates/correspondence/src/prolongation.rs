//! [`Prolongation`]: the matrix that carries values of a level to the next.

/// A sparse matrix by rows (CSR): row `i` has the columns `indices[indptr[i]..indptr[i + 1]]` with the values of the same places in `data`.
///
/// It has a row for every vertex of a level and a column for every one of the level before. A vertex that was there has 1 in its own
/// column, one in the middle of an edge .5 in the columns of both ends: linear subdivision.
#[derive(Clone, Debug, PartialEq)]
pub struct Prolongation {
    /// The values.
    pub data: Vec<f64>,
    /// Their columns, rising in each row.
    pub indices: Vec<u32>,
    /// Where each row begins, and the end of the last.
    pub indptr: Vec<u32>,
    /// Rows and columns.
    pub shape: [usize; 2],
}

impl Prolongation {
    /// The matrix of a level with these parents, to which `n_coarse` vertices come from the level before.
    pub(crate) fn new(parents: &[[u32; 2]], n_coarse: usize) -> Self {
        let (mut data, mut indices, mut indptr) = (Vec::new(), Vec::new(), vec![0]);
        for &[a, b] in parents {
            if a == b {
                data.push(1.0);
                indices.push(a);
            } else {
                data.extend([0.5; 2]);
                indices.extend([a, b]);
            }
            indptr.push(indices.len() as u32);
        }
        Self { data, indices, indptr, shape: [parents.len(), n_coarse] }
    }
}
