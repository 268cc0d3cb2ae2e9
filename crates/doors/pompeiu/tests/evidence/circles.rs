//! Files that use each other. A reader of either needs the other, and neither can be moved alone.
//!
//! File A uses file B if a `use` outside of tests in A names something that B defines. Names are followed through the modules that
//! re-export them, so a `use super::Name` of what a sibling defines is a use of the sibling. `pub use` of a module's own files makes
//! them visible and is no use; paths within expressions are not followed.

use super::architecture::{crate_folders, root};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Pairs of files that use each other, with the reason.
const ARGUED: [(&str, &str, &str); 1] = [(
    "crates/systems/contact/src/objective.rs",
    "crates/systems/contact/src/simulation.rs",
    "what a step minimises is read from the state of the simulation, which minimises it",
)];

/// A path of names from the root of a crate.
type Names = Vec<String>;

/// A file or an inline module.
#[derive(Default)]
struct Module {
    file: PathBuf,
    defined: BTreeSet<String>,
    imported: Vec<Import>,
}

/// One name that a `use` brings: `path` under `name`, or all of `path`.
struct Import {
    path: Names,
    name: Option<String>,
    exported: bool,
}

/// The modules of a crate by their paths.
type Modules = BTreeMap<Names, Module>;

/// Whether an item is compiled for tests only.
fn is_for_tests(attributes: &[syn::Attribute]) -> bool {
    let is_test = |tokens: &syn::MetaList| tokens.tokens.to_string() == "test";
    attributes.iter().any(|a| a.path().is_ident("cfg") && a.meta.require_list().is_ok_and(is_test))
}

/// Collects the modules of a file: `folder` is where its submodules lie.
fn read_file(file: &Path, folder: &Path, at: &Names, modules: &mut Modules) {
    let parsed = syn::parse_file(&fs::read_to_string(file).unwrap());
    let items = parsed.unwrap_or_else(|error| panic!("{}: {error}", file.display())).items;
    read_items(&items, file, folder, at, modules);
}

fn read_items(items: &[syn::Item], file: &Path, folder: &Path, at: &Names, modules: &mut Modules) {
    let mut module = Module { file: file.to_owned(), ..Module::default() };
    for item in items {
        let (attributes, name) = match item {
            syn::Item::Const(item) => (&item.attrs, Some(&item.ident)),
            syn::Item::Enum(item) => (&item.attrs, Some(&item.ident)),
            syn::Item::Fn(item) => (&item.attrs, Some(&item.sig.ident)),
            syn::Item::Macro(item) => (&item.attrs, item.ident.as_ref()),
            syn::Item::Mod(item) => (&item.attrs, None),
            syn::Item::Static(item) => (&item.attrs, Some(&item.ident)),
            syn::Item::Struct(item) => (&item.attrs, Some(&item.ident)),
            syn::Item::Trait(item) => (&item.attrs, Some(&item.ident)),
            syn::Item::Type(item) => (&item.attrs, Some(&item.ident)),
            syn::Item::Union(item) => (&item.attrs, Some(&item.ident)),
            syn::Item::Use(item) => (&item.attrs, None),
            _ => continue,
        };
        if is_for_tests(attributes) {
            continue;
        }
        module.defined.extend(name.map(ToString::to_string));
        match item {
            syn::Item::Mod(item) => read_module(item, file, folder, at, modules),
            syn::Item::Use(item) => {
                let exported = !matches!(item.vis, syn::Visibility::Inherited);
                read_use(&item.tree, &mut Vec::new(), exported, &mut module.imported);
            }
            _ => {}
        }
    }
    modules.insert(at.clone(), module);
}

fn read_module(item: &syn::ItemMod, file: &Path, folder: &Path, at: &Names, modules: &mut Modules) {
    let name = item.ident.to_string();
    let below: Names = at.iter().cloned().chain([name.clone()]).collect();
    let folder = folder.join(&name);
    if let Some((_, items)) = &item.content {
        read_items(items, file, &folder, &below, modules);
    } else {
        let (single, inside) = (folder.with_extension("rs"), folder.join("mod.rs"));
        let file = if single.is_file() { single } else { inside };
        read_file(&file, &folder, &below, modules);
    }
}

fn read_use(tree: &syn::UseTree, path: &mut Names, exported: bool, imports: &mut Vec<Import>) {
    match tree {
        syn::UseTree::Path(step) => {
            path.push(step.ident.to_string());
            read_use(&step.tree, path, exported, imports);
            path.pop();
        }
        syn::UseTree::Group(group) => {
            group.items.iter().for_each(|tree| read_use(tree, path, exported, imports));
        }
        syn::UseTree::Glob(_) => imports.push(Import { path: path.clone(), name: None, exported }),
        syn::UseTree::Name(syn::UseName { ident, .. }) if ident == "self" => {
            imports.push(Import { path: path.clone(), name: path.last().cloned(), exported });
        }
        syn::UseTree::Name(syn::UseName { ident, .. }) => {
            let whole = path.iter().cloned().chain([ident.to_string()]).collect();
            imports.push(Import { path: whole, name: Some(ident.to_string()), exported });
        }
        syn::UseTree::Rename(renamed) => {
            let whole = path.iter().cloned().chain([renamed.ident.to_string()]).collect();
            imports.push(Import { path: whole, name: Some(renamed.rename.to_string()), exported });
        }
    }
}

/// The path from the root of the crate, if it does not lead into another crate.
fn absolute(at: &Names, path: &[String], modules: &Modules) -> Option<Names> {
    let first = path.first()?;
    let (mut base, mut rest) = match first.as_str() {
        "crate" => (Vec::new(), &path[1..]),
        "self" => (at.clone(), &path[1..]),
        "super" => (at[..at.len() - 1].to_vec(), &path[1..]),
        _ => {
            let child: Names = at.iter().cloned().chain([first.clone()]).collect();
            let is_near = modules.contains_key(&child) || modules.get(at)?.defined.contains(first);
            return is_near.then(|| at.iter().chain(path).cloned().collect());
        }
    };
    while rest.first().is_some_and(|step| step == "super") {
        base.pop();
        rest = &rest[1..];
    }
    Some(base.into_iter().chain(rest.iter().cloned()).collect())
}

/// The file that defines what a path from the root names. `depth` ends re-exports in circles.
fn origin(path: &Names, modules: &Modules, depth: usize) -> Option<PathBuf> {
    if let Some(module) = modules.get(path) {
        return Some(module.file.clone());
    }
    let (name, at) = path.split_last()?;
    let at = at.to_vec();
    let Some(module) = modules.get(&at) else {
        // A name of an enum, or of a type's own.
        return origin(&at, modules, depth);
    };
    if module.defined.contains(name) || depth == 0 {
        return Some(module.file.clone());
    }
    let follow = |import: &Import| {
        let base = absolute(&at, &import.path, modules)?;
        if let Some(own) = &import.name {
            return (own == name).then(|| origin(&base, modules, depth - 1))?;
        }
        let inside: Names = base.iter().cloned().chain([name.clone()]).collect();
        let brings =
            |m: &Module| m.defined.contains(name) || m.imported.iter().any(|i| i.name.as_ref() == Some(name));
        let known = modules.contains_key(&inside) || modules.get(&base).is_some_and(brings);
        known.then(|| origin(&inside, modules, depth - 1))?
    };
    module.imported.iter().find_map(follow)
}

/// Pairs of files of a crate that use each other, by their paths below the root of the repository.
fn circles(folder: &str) -> Vec<(String, String)> {
    let source = root().join(folder).join("src");
    let mut modules = Modules::new();
    for name in ["lib.rs", "main.rs"] {
        if source.join(name).is_file() {
            read_file(&source.join(name), &source, &Names::new(), &mut modules);
            break;
        }
    }
    let mut uses = BTreeSet::new();
    for (at, module) in &modules {
        for import in module.imported.iter().filter(|import| !import.exported) {
            let Some(path) = absolute(at, &import.path, &modules) else { continue };
            if let Some(file) = origin(&path, &modules, 8).filter(|file| *file != module.file) {
                uses.insert((module.file.clone(), file));
            }
        }
    }
    let shown = |path: &PathBuf| path.strip_prefix(root()).unwrap().to_string_lossy().into_owned();
    let mutual = uses.iter().filter(|(a, b)| a < b && uses.contains(&(b.clone(), a.clone())));
    mutual.map(|(a, b)| (shown(a), shown(b))).collect()
}

#[test]
fn no_two_files_use_each_other() {
    let found: BTreeSet<_> = crate_folders().iter().flat_map(|folder| circles(folder)).collect();
    let argued = ARGUED.map(|(a, b, _reason)| (a.to_owned(), b.to_owned())).into();
    assert_eq!(found, argued, "pairs of files that use each other, and those with an argument");
}
