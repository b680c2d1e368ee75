//! The tables at the heads of source files say what the format has.

use super::defaults::{holds_range, is_stated};
use super::{repository, tables};
use chainlight::scene::schema::{MANUALS, bounds, scene_schema};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// A row of a manual: what it says of each of its parameters.
struct Row {
    names: Vec<String>,
    unit: String,
    default: String,
}

/// The rows of the table of parameters in a file's head; none where it has no such table.
fn rows(text: &str) -> Vec<Row> {
    let head = text.lines().filter_map(|line| line.strip_prefix("//! |"));
    let mut rows = head.skip_while(|line| !line.trim_start().starts_with("parameter |"));
    let heading = rows.next();
    if let Some(heading) = heading {
        assert_eq!(heading, " parameter | meaning | unit | default |");
    }
    rows.skip(1)
        .map(|line| {
            let cells: Vec<&str> = line.trim_end_matches('|').split('|').map(str::trim).collect();
            let [names, _, unit, default] = cells[..] else {
                panic!("four cells: {line}")
            };
            Row {
                names: names.split('`').skip(1).step_by(2).map(str::to_owned).collect(),
                unit: unit.to_owned(),
                default: default.to_owned(),
            }
        })
        .collect()
}

/// What a row says of a field that is not so.
fn lie(root: &Value, schema: &Value, required: bool, row: &Row) -> Option<String> {
    let stated = row.default.trim_start_matches('`');
    let default = schema.get("default").filter(|default| !default.is_null());
    let right = match default {
        _ if required => stated == "required",
        Some(default) => is_stated(root, schema, default, stated),
        // No value that a program could check: in words, or told in the row before.
        None => {
            stated != "required" && !stated.starts_with(|first: char| first.is_ascii_digit() || "([+-".contains(first))
        }
    };
    (!right).then(|| format!("`{}` for {:?}", row.default, default))
}

#[test]
fn manuals_have_every_parameter_with_its_default_and_range() {
    let root = scene_schema();
    let tables = tables(&root);
    let mut told: BTreeMap<(&str, &str), BTreeSet<String>> = BTreeMap::new();
    let mut ranges = 0;
    for (of, variant, files) in MANUALS {
        let table = tables.iter().find(|table| table.of == *of && table.variant == *variant);
        for file in *files {
            let text = fs::read_to_string(repository().join(file)).expect(file);
            for row in rows(&text) {
                let table = table.unwrap_or_else(|| panic!("{file}: the schema has no {of} {variant}"));
                for name in &row.names {
                    let place = format!("{file}: {name}");
                    let schema = table.schema["properties"].get(name);
                    let schema = schema.unwrap_or_else(|| panic!("{place} is no field of {of} {variant}"));
                    assert_eq!(lie(&root, schema, table.requires(name), &row), None, "{place}");
                    if let Some(at) = row.unit.find(['[', '(']) {
                        ranges += usize::from(holds_range(&root, schema, &row.unit[at + 1..], &place));
                        let closed = bounds(&root, schema).least.is_some_and(|(_, closed)| closed);
                        assert_eq!(row.unit[at..].starts_with('['), closed, "{place}");
                    }
                    told.entry((of, variant)).or_default().insert(name.clone());
                }
            }
        }
    }
    assert!(told.len() >= 17 && ranges > 30, "{} {ranges}", told.len());
    for ((of, variant), told) in told {
        // Of a shape, the lights' manual tells what makes it a light.
        if of == "Shape" {
            continue;
        }
        let table = tables.iter().find(|table| table.of == of && table.variant == variant);
        for (name, _) in table.expect("checked above").each() {
            assert!(told.contains(name), "no manual of {of} {variant} has `{name}`");
        }
    }
}

#[test]
fn every_table_of_parameters_belongs_to_a_variant() {
    fn walk(folder: &Path, found: &mut BTreeSet<String>) {
        for entry in folder.read_dir().expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                walk(&path, found);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).expect("text");
                if !rows(&text).is_empty() {
                    let path = path.strip_prefix(repository()).expect("inside");
                    found.insert(path.display().to_string().replace('\\', "/"));
                }
            }
        }
    }
    let mut found = BTreeSet::new();
    walk(&repository().join("src"), &mut found);
    let known: BTreeSet<String> = MANUALS
        .iter()
        .flat_map(|(.., files)| files.iter())
        .map(|file| (*file).to_owned())
        .collect();
    let missing: Vec<_> = found.difference(&known).collect();
    assert!(missing.is_empty(), "not in MANUALS: {missing:?}");
    assert!(found.len() >= 17, "{found:?}");
}

/// What has a plugin's file has a manual, and each file opens with the name of what it is.
#[test]
fn every_plugin_has_a_manual() {
    let root = scene_schema();
    let tables = tables(&root);
    for table in tables
        .iter()
        .filter(|table| ["Camera", "Texture", "Material", "Light"].contains(&table.of.as_str()))
    {
        let manual = MANUALS
            .iter()
            .find(|(of, variant, _)| *of == table.of && *variant == table.variant);
        assert!(manual.is_some(), "{}", table.variant);
        for file in manual.into_iter().flat_map(|(.., files)| files.iter()) {
            let text = fs::read_to_string(repository().join(file)).expect(file);
            assert!(text.starts_with(&format!("//! `{}", table.variant)), "{file}");
        }
    }
}

/// What a manual's head lacks of what every one has: what to use it for, what not to use it for, and a source with its year.
fn lacks(text: &str) -> Vec<&'static str> {
    let lines = text.lines().map_while(|line| line.strip_prefix("//!"));
    let head = lines.map(str::trim).collect::<Vec<_>>().join(" ");
    // Four digits between brackets: (Lambert 1760), and (2013) after a name.
    let is_dated = head.split('(').skip(1).any(|rest| {
        let inside = rest.split(')').next().unwrap_or_default();
        let words = inside.split(|c: char| !c.is_alphanumeric());
        let mut years = words.filter_map(|word| word.parse::<u32>().ok());
        years.any(|year| (1600..2100).contains(&year))
    });
    let has = |words: &str| head.contains(words);
    [
        ("Use it", head.starts_with("Use it ") || has(" Use it ")),
        ("Do not use it", has(" Do not use it ")),
        ("a source with its year", is_dated),
    ]
    .into_iter()
    .filter_map(|(part, there)| (!there).then_some(part))
    .collect()
}

#[test]
fn every_manual_says_what_to_use_it_for_and_what_not_and_its_source() {
    for file in MANUALS.iter().flat_map(|(.., files)| files.iter()) {
        let text = fs::read_to_string(repository().join(file)).expect(file);
        assert_eq!(lacks(&text), [""; 0], "{file}");
    }
    let whole = "//! `A`: a thing. Use it for\n//! this. Do not use it for that (Snell\n//! 1621).\n\nfn f() {}";
    assert_eq!(lacks(whole), [""; 0]);
    for (gone, part) in [
        ("Use it", "Use it"),
        ("Do not use it", "Do not use it"),
        ("1621", "a source with its year"),
        ("(", "a source with its year"),
    ] {
        assert_eq!(lacks(&whole.replacen(gone, "", 1)), [part], "{gone}");
    }
}

#[test]
fn a_manual_that_lies_is_caught() {
    let root = scene_schema();
    let sun = &root["$defs"]["Light"]["oneOf"][4]["properties"]["Sun"]["properties"];
    let said = |field: &str, required: bool, default: &str| {
        let row = Row {
            names: vec![field.to_owned()],
            unit: String::new(),
            default: default.to_owned(),
        };
        lie(&root, &sun[field], required, &row).is_some()
    };
    assert!(!said("turbidity", false, "3"));
    assert!(!said("turbidity", false, "3 (clear)"));
    assert!(!said("up", false, "(0, 1, 0)"));
    assert!(!said("direction", true, "required"));
    for (field, required, default) in [
        ("turbidity", false, "2"),
        ("turbidity", false, "3.5"),
        ("turbidity", false, "30"),
        ("turbidity", false, "required"),
        ("up", false, "(0, 0, 1)"),
        ("up", false, "1"),
        ("direction", true, "(0, 1, 0)"),
    ] {
        assert!(said(field, required, default), "{field} {default}");
    }
}
