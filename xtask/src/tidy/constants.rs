//! The page of all numbers that decide a result, `docs/constants.md`: named constants and the defaults of options, from the sources.

use super::modules::{Crate, attributes, is_test};
use crate::markdown::table;
use std::collections::BTreeMap;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, ExprStruct, Fields, ImplItem, ImplItemConst, Item, ItemConst, ItemImpl, Lit, Member, Meta, Type};

/// Types of numbers that somebody chose.
const NUMBERS: &[&str] = &["f64", "f32", "usize", "u32", "u64", "i32", "i64"];
/// Crates whose numbers change no result: pictures, files, what is printed.
const WITHOUT: &[&str] = &["view", "mesh-io", "cli"];
/// Longest value in the page; what is longer is cut.
const VALUE_CHARS: usize = 60;

/// A number with what is said of it.
struct Constant {
    name: String,
    value: String,
    /// The first sentence of its docs; empty without any.
    meaning: String,
    line: usize,
}

/// The text of the page, and what is missing in it: numbers that nothing is said of.
pub(super) fn page(crates: &[Crate]) -> (String, Vec<String>) {
    let mut text = String::new();
    let mut problems = Vec::new();
    let modules = crates.iter().flat_map(|krate| &krate.modules);
    let fields: BTreeMap<String, String> = modules.flat_map(|module| module.items.iter().flat_map(fields)).collect();
    for krate in crates {
        let name = krate.folder.strip_prefix("crates/").filter(|name| !WITHOUT.contains(name));
        let Some(name) = name else { continue };
        let mut rows = Vec::new();
        for (file, constant) in constants(krate, &fields) {
            let Constant { name, value, meaning, line } = constant;
            let path = format!("{}/src/{file}", krate.folder);
            if meaning.is_empty() {
                problems.push(format!(
                    "{path}:{line}: {name} has no docs: say in a sentence what it is, and what a change of it trades"
                ));
            }
            rows.push(vec![format!("`{name}`"), format!("`{value}`"), meaning, format!("[{file}](../{path})")]);
        }
        if !rows.is_empty() {
            text += &format!("## {name}\n\n{}\n", table(&["name", "value", "what it is", "file"], &rows));
        }
    }
    (text, problems)
}

/// The numbers of a crate with their files, in the order of the files' names, then as they stand. `fields` is what is said of those of
/// all structs, by `Struct.field`.
fn constants<'a>(krate: &'a Crate, fields: &BTreeMap<String, String>) -> Vec<(&'a str, Constant)> {
    let mut found = Vec::new();
    for module in &krate.modules {
        let mut finder = Finder { fields, options: String::new(), found: Vec::new() };
        module.items.iter().for_each(|item| finder.visit_item(item));
        found.extend(finder.found.into_iter().map(|constant| (module.file.as_str(), constant)));
    }
    found.sort_by_key(|&(file, _)| file);
    found
}

/// What is said of the fields of a struct, by `Struct.field`.
fn fields(item: &Item) -> Vec<(String, String)> {
    let Item::Struct(item) = item else { return Vec::new() };
    let Fields::Named(fields) = &item.fields else { return Vec::new() };
    let named = fields.named.iter().filter_map(|field| Some((field.ident.as_ref()?, first_sentence(&field.attrs))));
    named.map(|(field, meaning)| (format!("{}.{field}", item.ident), meaning)).collect()
}

struct Finder<'a> {
    fields: &'a BTreeMap<String, String>,
    /// The options whose defaults we are in; empty outside.
    options: String,
    found: Vec<Constant>,
}

impl Finder<'_> {
    fn add(&mut self, name: String, kind: &Type, value: &Expr, attributes: &[Attribute]) {
        if is_number(kind) {
            self.found.push(Constant {
                name,
                value: source(value),
                meaning: first_sentence(attributes),
                line: value.span().start().line,
            });
        }
    }
}

impl<'a> Visit<'a> for Finder<'_> {
    fn visit_item(&mut self, item: &'a Item) {
        if !is_test(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_const(&mut self, item: &'a ItemConst) {
        self.add(item.ident.to_string(), &item.ty, &item.expr, &item.attrs);
    }

    fn visit_impl_item_const(&mut self, item: &'a ImplItemConst) {
        self.add(item.ident.to_string(), &item.ty, &item.expr, &item.attrs);
    }

    fn visit_item_impl(&mut self, item: &'a ItemImpl) {
        let is_default = item.trait_.as_ref().is_some_and(|(_, path, _)| path.is_ident("Default"));
        let of = source(&item.self_ty);
        if is_default && of.ends_with("Options") && item.items.iter().all(|item| matches!(item, ImplItem::Fn(_))) {
            self.options = of;
        }
        visit::visit_item_impl(self, item);
        self.options.clear();
    }

    /// The defaults of options, and of options inside them.
    fn visit_expr_struct(&mut self, made: &'a ExprStruct) {
        let of = match source(&made.path) {
            of if of == "Self" => self.options.clone(),
            of => of,
        };
        let inside = if of == self.options { String::new() } else { format!("{}: ", self.options) };
        for field in made.fields.iter().filter(|field| !self.options.is_empty() && is_chosen(&field.expr)) {
            let Member::Named(member) = &field.member else { continue };
            let name = format!("{of}.{member}");
            let meaning = self.fields.get(&name).cloned().unwrap_or_default();
            let line = field.span().start().line;
            self.found.push(Constant { name: format!("{inside}{name}"), value: source(&field.expr), meaning, line });
        }
        visit::visit_expr_struct(self, made);
    }
}

/// A number, or several.
fn is_number(kind: &Type) -> bool {
    match kind {
        Type::Array(array) => is_number(&array.elem) && !matches!(*array.elem, Type::Array(_)),
        Type::Path(path) => path.path.get_ident().is_some_and(|name| NUMBERS.contains(&name.to_string().as_str())),
        _ => false,
    }
}

/// A default that is a number, a yes or no, or one of several ways.
fn is_chosen(value: &Expr) -> bool {
    match value {
        Expr::Lit(value) => matches!(value.lit, Lit::Int(_) | Lit::Float(_) | Lit::Bool(_)),
        Expr::Unary(value) => is_chosen(&value.expr),
        Expr::Binary(_) | Expr::Array(_) => true,
        Expr::Call(call) => call.args.iter().any(is_chosen),
        Expr::Path(path) => {
            path.path.segments.len() > 1 || path.path.get_ident().is_some_and(|name| *name == name.to_string().to_uppercase())
        }
        _ => false,
    }
}

/// As it stands in the source, on one line.
fn source(node: &impl Spanned) -> String {
    let text = node.span().source_text().unwrap_or_default();
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(VALUE_CHARS) {
        Some((end, _)) => format!("{} ...", &line[..end]),
        None => line,
    }
}

/// The first sentence of the docs.
fn first_sentence(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter_map(|attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("doc") => Some(&pair.value),
        _ => None,
    });
    let lines = lines.filter_map(|value| match value {
        Expr::Lit(value) => match &value.lit {
            Lit::Str(text) => Some(text.value().trim().to_owned()),
            _ => None,
        },
        _ => None,
    });
    let paragraph = lines.take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    // Links between items lead nowhere in a page.
    let paragraph = paragraph.replace("[`", "`").replace("`]", "`");
    // A point ends a sentence where the next one begins, with a capital: not in "0.5", "sec. 4" or "e.g. this".
    let mut points = paragraph.match_indices(". ").map(|(point, _)| point);
    let end = points.find(|point| paragraph[point + 2..].starts_with(char::is_uppercase));
    match end {
        Some(point) => paragraph[..=point].to_owned(),
        None => paragraph,
    }
}

#[cfg(test)]
mod tests {
    use super::super::names::tests::made_of;
    use super::*;

    fn rows(text: &str) -> (Vec<String>, Vec<String>) {
        let (page, problems) = page(&[made_of(&[("lib.rs", text)])]);
        (page.lines().skip(4).filter(|line| !line.is_empty()).map(str::to_owned).collect(), problems)
    }

    #[test]
    fn constants_are_listed_with_value_and_meaning() {
        let (found, problems) = rows(
            "/// Share of .5 of [`S`], sec. 4. More\n/// is dearer.\npub(crate) const A: f64 = 1.0 / 3.0;\n\
             fn f() {\n    /// In a function.\n    const B: [usize; 2] = [1,\n        2];\n}\n\
             /// No number.\nconst C: &str = \"\";\n/// A table.\nconst D: [[u32; 3]; 1] = [[0; 3]];\n\
             struct S;\nimpl S {\n    /// Of a type | with a bar.\n    const E: u32 = 7;\n}\n\
             #[cfg(test)]\nmod tests {\n    const F: f64 = 2.0;\n}\n",
        );
        assert_eq!(
            found,
            [
                "| `A` | `1.0 / 3.0` | Share of .5 of `S`, sec. 4. | [lib.rs](../crates/x/src/lib.rs) |",
                "| `B` | `[1, 2]` | In a function. | [lib.rs](../crates/x/src/lib.rs) |",
                "| `E` | `7` | Of a type \\| with a bar. | [lib.rs](../crates/x/src/lib.rs) |",
            ]
        );
        assert_eq!(problems, [""; 0]);
    }

    #[test]
    fn defaults_of_options_are_listed() {
        let (found, problems) = rows(
            "struct AOptions {\n    /// Steps.\n    steps: usize,\n    /// Which.\n    kind: Kind,\n    b: BOptions,\n    list: Vec<u32>,\n}\n\
             struct BOptions {\n    /// Weight. Default 2.\n    weight: f64,\n}\n\
             impl Default for AOptions {\n    fn default() -> Self {\n        \
             Self { steps: 3, kind: Kind::Even, b: BOptions { weight: -0.5 }, list: Vec::new() }\n    }\n}\n\
             impl Default for Other {\n    fn default() -> Self {\n        Self { steps: 3 }\n    }\n}\n",
        );
        let names: Vec<&str> = found.iter().map(|row| row.split(" | [").next().unwrap_or_default()).collect();
        assert_eq!(
            names,
            [
                "| `AOptions.steps` | `3` | Steps.",
                "| `AOptions.kind` | `Kind::Even` | Which.",
                "| `AOptions: BOptions.weight` | `-0.5` | Weight.",
            ]
        );
        assert_eq!(problems, [""; 0]);
    }

    #[test]
    fn what_has_no_docs_is_named() {
        let (_, problems) = rows("//! Docs.\nconst A: f64 = 1.0;\n// Not docs.\nconst B: usize = 2;\n");
        assert_eq!(problems.len(), 2);
        assert!(problems[0].starts_with("crates/x/src/lib.rs:2: A has no docs"), "{problems:?}");
    }
}
