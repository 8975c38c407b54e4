//! Which file of a crate a path leads to.

use super::modules::{Crate, Module};

/// Longest chain of re-exports that is followed: one that goes round in a circle ends here.
const MAX_STEPS: usize = 16;

impl Crate {
    /// The module that defines what `path`, as it stands in module `from`, leads to: all re-exports on the way are followed. The
    /// module itself where the path leads to a module; `None` for what is of another crate, local or unknown.
    pub(super) fn resolve(&self, from: usize, path: &[String]) -> Option<usize> {
        self.follow(from, path, MAX_STEPS)
    }

    fn follow(&self, from: usize, path: &[String], steps: usize) -> Option<usize> {
        let Some((first, rest)) = path.split_first() else { return Some(from) };
        let steps = steps.checked_sub(1)?;
        let module: &Module = &self.modules[from];
        match first.as_str() {
            "crate" => return self.follow(0, rest, steps),
            "self" => return self.follow(from, rest, steps),
            "super" => return self.follow(module.parent, rest, steps),
            _ => {}
        }
        if let Some(&child) = module.children.get(first) {
            // A function may have the name of its module: `crate::relax` after `pub use relax::relax`. Both are in one file.
            return self.follow(child, rest, steps);
        }
        if module.defined.contains(first) {
            return Some(from);
        }
        if let Some(import) = module.imports.iter().find(|import| import.name == *first) {
            return self.follow(from, &[import.path.as_slice(), rest].concat(), steps);
        }
        let globs = module.imports.iter().filter(|import| import.name == "*" && self.is_inside(module, &import.path[0]));
        let mut modules = globs.filter_map(|import| self.follow(from, &import.path, steps));
        modules.find_map(|module| self.follow(module, path, steps))
    }

    /// Whether a path that begins so stays in the crate.
    fn is_inside(&self, module: &Module, first: &str) -> bool {
        ["crate", "self", "super"].contains(&first) || module.children.contains_key(first)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A crate of these files; each is declared by the first one whose path is its folder, else by the first of all.
    pub(in crate::tidy) fn made_of(files: &[(&str, &str)]) -> Crate {
        let mut modules: Vec<Module> = Vec::new();
        for (file, text) in files {
            let (folder, name) = file.trim_end_matches(".rs").rsplit_once('/').unwrap_or(("", file.trim_end_matches(".rs")));
            let parent = modules.iter().position(|m| m.file == format!("{folder}.rs")).unwrap_or(0);
            let place = modules.len();
            modules.push(Module::parse(file, text, parent).unwrap());
            if place > 0 {
                modules[parent].children.insert(name.to_owned(), place);
            }
        }
        Crate { folder: "crates/x".to_owned(), modules }
    }

    #[test]
    fn re_exports_are_followed_to_the_definition() {
        let made = made_of(&[
            ("lib.rs", "mod a; mod b; pub use a::relax; pub use b::*; use glam::DVec3; pub fn root() {}"),
            ("a.rs", "mod c; pub use c::Deep as Renamed; pub use c::Deep; use super::b; pub fn relax() {}"),
            ("a/c.rs", "pub struct Deep;"),
            ("b.rs", "pub struct Globbed; pub use crate::Loop as Loop;"),
        ]);
        let file = |from: usize, path: &str| {
            let path: Vec<String> = path.split("::").map(str::to_owned).collect();
            made.resolve(from, &path).map_or("none", |m| made.modules[m].file.as_str())
        };
        assert_eq!(file(3, "crate::relax"), "a.rs");
        assert_eq!(file(3, "crate::a::Renamed"), "a/c.rs");
        assert_eq!(file(3, "super::a::Deep::new"), "a/c.rs");
        assert_eq!(file(2, "super::super::Globbed"), "b.rs");
        assert_eq!(file(2, "super::b::Globbed"), "b.rs");
        assert_eq!(file(1, "c::Deep"), "a/c.rs");
        assert_eq!(file(1, "crate::root"), "lib.rs");
        assert_eq!(file(1, "crate::b"), "b.rs");
        for unknown in ["crate::DVec3", "std::fs::File", "Local", "crate::Loop"] {
            assert_eq!(file(1, unknown), "none", "{unknown}");
        }
    }
}
