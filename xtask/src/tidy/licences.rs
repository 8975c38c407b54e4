//! Licences of everything that we build with.

use super::metadata::{packages, text};
use serde_json::Value;

/// Licences that let others use our crates as they like.
const ALLOWED: &[&str] = &[
    "MIT",
    "MIT-0",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-1-Clause",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "0BSD",
    "Zlib",
    "ISC",
    "Unicode-3.0",
    "Unicode-DFS-2016",
    "CC0-1.0",
    "Unlicense",
    "BSL-1.0",
];

/// Every package of the dependency tree whose licence is not among those allowed.
pub(super) fn check(metadata: &Value) -> Vec<String> {
    let refused = packages(metadata, false).filter(|p| !is_allowed(text(p, "license")));
    refused.map(|p| format!("{} {} has the licence '{}'", text(p, "name"), text(p, "version"), text(p, "license"))).collect()
}

/// An SPDX expression of allowed licences: one of the alternatives must have all its parts allowed. `/` is an old way to write OR.
fn is_allowed(expression: &str) -> bool {
    let alternatives = expression.replace(['(', ')'], "").replace('/', " OR ");
    alternatives.split(" OR ").any(|all| all.split(" AND ").all(|licence| ALLOWED.contains(&licence.trim())))
}

#[cfg(test)]
mod tests {
    use super::is_allowed;

    #[test]
    fn expressions() {
        for good in ["MIT", "MIT/Apache-2.0", "MPL-2.0 OR MIT", "(MIT OR Apache-2.0) AND Unicode-3.0"] {
            assert!(is_allowed(good), "{good}");
        }
        for bad in ["", "MPL-2.0", "GPL-3.0-only", "MIT AND GPL-3.0-only"] {
            assert!(!is_allowed(bad), "{bad}");
        }
    }
}
