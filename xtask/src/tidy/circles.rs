//! No files of a crate that use each other in a circle: where each needs the other, neither can be read, tested or moved alone.
//!
//! `lib.rs` and `main.rs` are no part of it. A name that is re-exported counts as of the file that defines it, so a parent module that
//! only declares and re-exports its children is no part of it either.

use super::modules::{Crate, Import, attributes, is_test, names};
use proc_macro2::{TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{ImplItem, Item, ItemMod, ItemUse, Macro, Path, Visibility};

/// For each pair of modules, user first, what is used of the other, and in which line it stands first.
type Uses = BTreeMap<(usize, usize), (String, usize)>;

/// Every set of files that use each other.
pub(super) fn check(krate: &Crate) -> Vec<String> {
    let uses = uses(krate);
    circles(&uses).iter().map(|circle| told(krate, circle, &uses)).collect()
}

fn told(krate: &Crate, circle: &BTreeSet<usize>, uses: &Uses) -> String {
    let file = |module: usize| krate.modules[module].file.as_str();
    let files: Vec<&str> = circle.iter().map(|&module| file(module)).collect();
    let mut text = format!(
        "{}/src: {} use each other in a circle: move what several need to a file of its own",
        krate.folder,
        files.join(", ")
    );
    for (&(user, used), (what, line)) in uses.iter().filter(|((a, b), _)| circle.contains(a) && circle.contains(b)) {
        text += &format!("\n    {}:{line} uses {what} of {}", file(user), file(used));
    }
    text
}

/// The sets of more than one module in which every one leads to every other.
fn circles(uses: &Uses) -> Vec<BTreeSet<usize>> {
    let mut reached: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for start in uses.keys().map(|&(user, _)| user) {
        let mut seen = BTreeSet::new();
        let mut open = vec![start];
        while let Some(module) = open.pop() {
            let next = uses.range((module, 0)..=(module, usize::MAX)).map(|(&(_, used), _)| used);
            open.extend(next.filter(|&used| seen.insert(used)).collect::<Vec<_>>());
        }
        reached.insert(start, seen);
    }
    let leads = |a: usize, b: usize| reached.get(&a).is_some_and(|seen| seen.contains(&b));
    let circle = |a: usize| reached.keys().copied().filter(|&b| leads(a, b) && leads(b, a)).collect::<BTreeSet<_>>();
    reached.keys().map(|&a| circle(a)).filter(|circle| circle.len() > 1).collect::<BTreeSet<_>>().into_iter().collect()
}

/// Who uses whom among the modules but for the first.
fn uses(krate: &Crate) -> Uses {
    let mut uses = Uses::new();
    for (place, module) in krate.modules.iter().enumerate().skip(1) {
        let mut paths = Paths::default();
        module.items.iter().for_each(|item| paths.visit_item(item));
        let names: BTreeSet<&str> = paths.found.iter().map(|(path, _)| path[0].as_str()).collect();
        // A re-export is used here only where its name is.
        let used_here = |import: &&Import| !import.public || names.contains(import.name.as_str());
        let imports = module.imports.iter().filter(used_here).map(|import| (import.path.clone(), import.line));
        for (path, line) in imports.chain(paths.found.iter().cloned()) {
            let used = krate.resolve(place, &path).filter(|&used| used != place && used != 0);
            // To name a module that defines nothing is to use none of it; what is used of its children is found by itself.
            if let Some(used) = used.filter(|&used| !krate.modules[used].defined.is_empty()) {
                let first = uses.entry((place, used)).or_insert_with(|| (path.join("::"), line));
                if line < first.1 {
                    *first = (path.join("::"), line);
                }
            }
        }
    }
    uses
}

/// All paths of a module's code but for its own `use` declarations, with their lines.
#[derive(Default)]
struct Paths {
    found: Vec<(Vec<String>, usize)>,
    /// How many modules inside the file we are in.
    inside: usize,
}

impl Paths {
    fn add(&mut self, path: Vec<String>, line: usize) {
        // From a module inside the file the first steps up stay in the file.
        let up = path.iter().take_while(|segment| *segment == "super").count().min(self.inside);
        self.found.extend((path.len() > up).then(|| (path[up..].to_vec(), line)));
    }

    /// Paths in the arguments of macros: names joined by `::`.
    fn add_tokens(&mut self, tokens: TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let mut line = 0;
        let mut colons = 0;
        for token in tokens {
            match &token {
                TokenTree::Punct(punct) if punct.as_char() == ':' => colons += 1,
                TokenTree::Ident(name) if colons == 2 && !path.is_empty() => {
                    path.push(name.to_string());
                    colons = 0;
                }
                other => {
                    self.end_path(&mut path, line);
                    colons = 0;
                    match other {
                        TokenTree::Ident(name) => (path, line) = (vec![name.to_string()], name.span().start().line),
                        TokenTree::Group(group) => self.add_tokens(group.stream()),
                        _ => {}
                    }
                }
            }
        }
        self.end_path(&mut path, line);
    }

    fn end_path(&mut self, path: &mut Vec<String>, line: usize) {
        if !path.is_empty() {
            self.add(std::mem::take(path), line);
        }
    }
}

impl<'a> Visit<'a> for Paths {
    fn visit_path(&mut self, path: &'a Path) {
        if path.leading_colon.is_none() {
            self.add(path.segments.iter().map(|s| s.ident.to_string()).collect(), path.span().start().line);
        }
        visit::visit_path(self, path);
    }

    fn visit_item(&mut self, item: &'a Item) {
        if !is_test(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item(&mut self, item: &'a ImplItem) {
        let attributes: &[syn::Attribute] = match item {
            ImplItem::Const(item) => &item.attrs,
            ImplItem::Fn(item) => &item.attrs,
            ImplItem::Type(item) => &item.attrs,
            _ => &[],
        };
        if !is_test(attributes) {
            visit::visit_impl_item(self, item);
        }
    }

    /// Those of the module itself are in its imports; these are in functions and modules inside the file.
    fn visit_block(&mut self, block: &'a syn::Block) {
        for statement in &block.stmts {
            if let syn::Stmt::Item(Item::Use(item)) = statement {
                self.add_use(item);
            }
        }
        visit::visit_block(self, block);
    }

    fn visit_item_mod(&mut self, item: &'a ItemMod) {
        self.inside += 1;
        for item in item.content.iter().flat_map(|(_, items)| items) {
            if let Item::Use(item) = item {
                self.add_use(item);
            }
        }
        visit::visit_item_mod(self, item);
        self.inside -= 1;
    }

    fn visit_macro(&mut self, call: &'a Macro) {
        self.add_tokens(call.tokens.clone());
        visit::visit_macro(self, call);
    }

    /// `pub(super)` and `pub(in crate::a)` use nothing.
    fn visit_visibility(&mut self, _: &'a Visibility) {}
}

impl Paths {
    fn add_use(&mut self, item: &ItemUse) {
        let line = item.use_token.span.start().line;
        if item.leading_colon.is_none() {
            names(&item.tree).into_iter().for_each(|(_, path)| self.add(path, line));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::names::tests::made_of;
    use super::*;

    fn problems(files: &[(&str, &str)]) -> Vec<String> {
        check(&made_of(files))
    }

    #[test]
    fn two_files_that_use_each_other_are_told() {
        let found = problems(&[
            ("lib.rs", "mod a; mod b; mod c;"),
            ("a.rs", "use crate::b::B;\npub struct A;"),
            ("b.rs", "pub struct B;\nfn f() { crate::a::A; }"),
            ("c.rs", "use crate::a::A;"),
        ]);
        assert_eq!(found.len(), 1);
        assert!(found[0].starts_with("crates/x/src: a.rs, b.rs use each other"), "{found:?}");
        assert!(found[0].contains("\n    a.rs:1 uses crate::b::B of b.rs"), "{found:?}");
        assert!(found[0].contains("\n    b.rs:2 uses crate::a::A of a.rs"), "{found:?}");
    }

    #[test]
    fn circles_do_not_hide_behind_re_exports() {
        let lib = ("lib.rs", "mod a; mod b; pub use a::A; pub(crate) use b::B;");
        let a = ("a.rs", "use crate::B; pub struct A;");
        assert_eq!(problems(&[lib, a, ("b.rs", "use super::A; pub struct B;")]).len(), 1);
        assert_eq!(problems(&[lib, a, ("b.rs", "pub struct B;")]), [""; 0]);
        // What lib.rs itself defines is of no file.
        assert_eq!(problems(&[("lib.rs", "mod a; use a::A; pub struct L;"), ("a.rs", "use crate::L; pub struct A;")]), [""; 0]);
    }

    #[test]
    fn a_parent_is_looked_through_where_it_has_no_code() {
        let lib = ("lib.rs", "mod p;");
        let child = ("p/b.rs", "use super::A; pub struct B;");
        assert_eq!(
            problems(&[lib, ("p.rs", "mod a; mod b; pub use a::A; pub use b::B;"), ("p/a.rs", "pub struct A;"), child]),
            [""; 0]
        );
        let a = ("p/a.rs", "use super::B; pub struct A;");
        assert_eq!(problems(&[lib, ("p.rs", "mod a; mod b; pub use a::A; pub use b::B;"), a, child]).len(), 1);
        assert_eq!(problems(&[lib, ("p.rs", "mod b; use b::B; pub struct A;"), child]).len(), 1);
        // Without a use of its own name a re-export is there for others.
        assert_eq!(problems(&[lib, ("p.rs", "mod b; pub use b::B; pub struct A;"), child]), [""; 0]);
        assert_eq!(problems(&[lib, ("p.rs", "mod b; pub use b::B; pub struct A; fn f(_: B) {}"), child]).len(), 1);
    }

    #[test]
    fn paths_are_found_wherever_they_stand() {
        let lib = ("lib.rs", "mod a; mod b;");
        let b = ("b.rs", "use crate::a::A; pub struct B; pub const C: usize = 1;");
        for code in [
            "fn f() { use crate::b::B; }",
            "fn f() { let _ = vec![(0, crate::b::B)]; }",
            "fn f(_: Option<&super::b::B>) {}",
            "use crate::b; fn f() { b::B; }",
            "use super::b as c; type T = [c::B; 2];",
            "mod inside { use super::super::b::B; }",
            "impl A { fn f() -> crate::b::B {} }",
            "use crate::b::*;",
        ] {
            assert_eq!(problems(&[lib, ("a.rs", &format!("{code} pub struct A;")), b]).len(), 1, "{code}");
        }
        for code in [
            "#[cfg(test)] mod tests { use crate::b::B; }",
            "impl A { #[cfg(test)] fn f() -> crate::b::B {} }",
            "#[cfg(test)] fn f() { crate::b::B; }",
            "/// See `crate::b::B`.\nfn f() { println!(\"crate::b::B\") }",
            "fn f(b: usize) { b; std::b::B; b.B; }",
            "pub(in crate::b) fn f() {}",
        ] {
            assert_eq!(problems(&[lib, ("a.rs", &format!("{code} pub struct A;")), b]), [""; 0], "{code}");
        }
    }

    #[test]
    fn longer_circles_are_told_once_with_all_their_files() {
        let found = problems(&[
            ("lib.rs", "mod a; mod b; mod c; mod d;"),
            ("a.rs", "use crate::b::B; pub struct A;"),
            ("b.rs", "use crate::c::C; pub struct B;"),
            ("c.rs", "use crate::a::A; use crate::d::D; pub struct C;"),
            ("d.rs", "pub struct D;"),
        ]);
        assert_eq!(found.len(), 1);
        assert!(found[0].contains("a.rs, b.rs, c.rs use"), "{found:?}");
        assert_eq!(found[0].lines().count(), 4);
    }
}
