//! The sources of a crate as a tree of modules, without their tests.

use anyhow::{Context, Result, bail};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use syn::{Attribute, Item, UseTree, Visibility};

/// A crate's modules, from `lib.rs` or `main.rs`, which is the first of them. Modules that only tests have are left out.
pub(super) struct Crate {
    /// Its folder, from the workspace's.
    pub(super) folder: String,
    pub(super) modules: Vec<Module>,
}

/// A file of a crate.
pub(super) struct Module {
    /// Its path below `src`.
    pub(super) file: String,
    /// The module that declares it; the first module declares itself.
    pub(super) parent: usize,
    /// Modules that it declares, by name.
    pub(super) children: BTreeMap<String, usize>,
    /// Names of the items that the file itself defines.
    pub(super) defined: BTreeSet<String>,
    /// What its `use` declarations bring in, but for those inside functions.
    pub(super) imports: Vec<Import>,
    /// Items but for tests.
    pub(super) items: Vec<Item>,
}

/// One name that a `use` declaration brings in.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Import {
    /// What the name is here; `*` for all names of the module that `path` leads to.
    pub(super) name: String,
    /// What it stands for.
    pub(super) path: Vec<String>,
    /// Others may use the name from here, so it may be here for them only.
    pub(super) public: bool,
    /// Line in the file.
    pub(super) line: usize,
}

impl Crate {
    /// Reads a crate by its folder in the workspace's folder `root`, from its `src/lib.rs` or `src/main.rs`.
    pub(super) fn read(root: &Path, folder: &str) -> Result<Self> {
        let src = root.join(folder).join("src");
        let first = ["lib.rs", "main.rs"].into_iter().find(|file| src.join(file).is_file());
        let Some(first) = first else { bail!("{folder} has neither src/lib.rs nor src/main.rs") };
        let mut modules = Vec::new();
        read_module(&mut modules, &src, PathBuf::from(first), PathBuf::new(), 0)?;
        Ok(Self { folder: folder.to_owned(), modules })
    }
}

/// Reads a file and the modules that it declares, which are in `folder`; both are below `src`. Returns its place in `modules`.
fn read_module(modules: &mut Vec<Module>, src: &Path, file: PathBuf, folder: PathBuf, parent: usize) -> Result<usize> {
    let path = src.join(&file);
    let text = fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
    let place = modules.len();
    modules.push(Module::parse(&file.display().to_string(), &text, parent)?);
    let declared: Vec<String> = modules[place].items.iter().filter_map(declared_module).collect();
    for name in declared {
        let below = folder.join(&name);
        let alone = folder.join(format!("{name}.rs"));
        let file = if src.join(&alone).is_file() { alone } else { below.join("mod.rs") };
        let child = read_module(modules, src, file, below, place)?;
        modules[place].children.insert(name, child);
    }
    Ok(place)
}

impl Module {
    /// A module from its text; the modules that it declares are not read.
    pub(super) fn parse(file: &str, text: &str, parent: usize) -> Result<Self> {
        let parsed = syn::parse_file(text).with_context(|| format!("{file} cannot be parsed"))?;
        let items: Vec<Item> = parsed.items.into_iter().filter(|item| !is_test(attributes(item))).collect();
        let mut imports = Vec::new();
        for item in &items {
            if let Item::Use(item) = item.clone() {
                let line = item.use_token.span.start().line;
                let public = !matches!(item.vis, Visibility::Inherited);
                let from_outside = item.leading_colon.is_some();
                let found = names(&item.tree).into_iter().filter(|_| !from_outside);
                imports.extend(found.map(|(name, path)| Import { name, path, public, line }));
            }
        }
        let defined = items.iter().filter_map(defined_name).collect();
        Ok(Self { file: file.to_owned(), parent, children: BTreeMap::new(), defined, imports, items })
    }
}

/// Every name in a `use` tree, with the path that it stands for.
pub(super) fn names(tree: &UseTree) -> Vec<(String, Vec<String>)> {
    match tree {
        UseTree::Path(path) => {
            let first = path.ident.to_string();
            let rest = names(&path.tree).into_iter();
            // `use a::b::{self}` brings in `b`, which is `a::b`.
            rest.map(|(name, rest)| match (name.as_str(), rest.as_slice()) {
                ("self", [_]) => (first.clone(), vec![first.clone()]),
                (_, [last]) if last == "self" => (name, vec![first.clone()]),
                _ => (name, [vec![first.clone()], rest].concat()),
            })
            .collect()
        }
        UseTree::Name(name) => vec![(name.ident.to_string(), vec![name.ident.to_string()])],
        UseTree::Rename(rename) => vec![(rename.rename.to_string(), vec![rename.ident.to_string()])],
        UseTree::Glob(_) => vec![("*".to_owned(), Vec::new())],
        UseTree::Group(group) => group.items.iter().flat_map(names).collect(),
    }
}

/// The name of a module that has a file of its own.
fn declared_module(item: &Item) -> Option<String> {
    match item {
        Item::Mod(item) if item.content.is_none() => Some(item.ident.to_string()),
        _ => None,
    }
}

/// The name of an item that others can use by a path; a module inside the file is one.
fn defined_name(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        Item::Mod(item) if item.content.is_some() => &item.ident,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::TraitAlias(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Union(item) => &item.ident,
        _ => return None,
    };
    Some(name.to_string())
}

/// The attributes of an item.
pub(super) fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::ExternCrate(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Union(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

/// There for tests only: `#[cfg(test)]`.
pub(super) fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|a| a.path().is_ident("cfg") && a.parse_args::<syn::Path>().is_ok_and(|what| what.is_ident("test")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn imports(text: &str) -> Vec<String> {
        let module = Module::parse("a.rs", text, 0).unwrap();
        module.imports.iter().map(|i| format!("{}={}", i.name, i.path.join("::"))).collect()
    }

    #[test]
    fn use_trees_are_taken_apart() {
        assert_eq!(imports("use crate::a::B;"), ["B=crate::a::B"]);
        assert_eq!(imports("use crate::{a::{self, B as C}, d::*};"), ["a=crate::a", "C=crate::a::B", "*=crate::d"]);
        assert_eq!(imports("use super::a::{self as b};"), ["b=super::a"]);
        assert_eq!(imports("use ::fit::A;"), [""; 0]);
        assert_eq!(imports("#[cfg(test)]\nuse super::a;\n#[cfg(test)]\nmod tests { use super::*; }"), [""; 0]);
    }

    #[test]
    fn items_are_known_by_name() {
        let module = Module::parse("a.rs", "mod b;\nstruct C;\nimpl C {}\nfn d() {}\n#[cfg(test)]\nmod tests {}", 0).unwrap();
        assert_eq!(module.defined.iter().collect::<Vec<_>>(), ["C", "d"]);
        assert_eq!(module.items.iter().filter_map(declared_module).collect::<Vec<_>>(), ["b"]);
        assert!(Module::parse("a.rs", "fn (", 0).is_err());
    }

    #[test]
    fn our_own_modules_are_read() {
        let own = Crate::read(&crate::root(), "xtask").unwrap();
        let parent = |file: &str| own.modules.iter().find(|m| m.file == file).map(|m| own.modules[m.parent].file.as_str());
        assert_eq!(parent("tidy/modules.rs"), Some("tidy.rs"));
        assert_eq!(parent("tidy.rs"), Some("main.rs"));
        assert!(Crate::read(&crate::root(), "docs").is_err());
    }
}
