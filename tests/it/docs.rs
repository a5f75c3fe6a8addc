//! The book is true where a test can tell: excerpts are lines of the files that they name, links and paths lead somewhere, and
//! every verb, model and law has its place.

use std::fs;
use std::path::{Path, PathBuf};

use bedload::closures::{Standing, catalogue};

use crate::support::{REGISTRY, Scratch, files, project};

/// What stands before the fence of an excerpt, and after the name of its file.
const EXCERPT: (&str, &str) = ("<!-- excerpt: ", " -->");
/// Folders of the project; a word in code that begins with one is the path of a file.
const FOLDERS: [&str; 7] = ["benches/", "cases/", "docs/", "examples/", "reference/", "src/", "tests/"];

/// A page: where it is, and its text.
struct Page {
    path: PathBuf,
    text: String,
}

/// The pages of the book, and those beside it.
fn pages() -> Vec<Page> {
    let beside = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(project);
    let pages = files(&project("docs"), "md").into_iter().chain(beside);
    pages.map(|path| Page { text: fs::read_to_string(&path).unwrap(), path }).collect()
}

impl Page {
    fn name(&self) -> String {
        self.path.strip_prefix(project("")).unwrap().display().to_string()
    }

    /// The lines that are not code, each with its number.
    fn prose(&self) -> Vec<(usize, &str)> {
        let mut fenced = false;
        let mut prose = Vec::new();
        for (i, line) in self.text.lines().enumerate() {
            if line.trim_start().starts_with("```") {
                fenced = !fenced;
            } else if !fenced {
                prose.push((i + 1, line));
            }
        }
        assert!(!fenced, "{}: a fence is open at the end", self.name());
        prose
    }

    /// What a link to a heading calls it.
    fn anchors(&self) -> Vec<String> {
        let headings = self.prose().into_iter().filter_map(|(_, line)| line.strip_prefix('#'));
        headings.map(|heading| anchor(heading.trim_start_matches('#').trim())).collect()
    }
}

/// A heading as a link calls it: lower case, hyphens for spaces, no other signs.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|&c| c.is_alphanumeric() || " -_".contains(c));
    kept.map(|c| if c == ' ' { "-".to_owned() } else { c.to_lowercase().collect() }).collect()
}

/// Excerpts: the file that each names, and its lines.
fn excerpts(text: &str) -> Vec<(String, Vec<String>)> {
    let mut found = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let file = line.strip_prefix(EXCERPT.0).and_then(|rest| rest.strip_suffix(EXCERPT.1));
        let Some(file) = file else { continue };
        let fence = lines.next().unwrap_or_default();
        assert!(fence.starts_with("```"), "no fence follows {line}");
        let code = lines.by_ref().take_while(|line| !line.starts_with("```"));
        found.push((file.to_owned(), code.map(|line| line.trim_end().to_owned()).collect()));
    }
    found
}

/// Whether the lines of an excerpt follow each other in a text, white space at their ends aside.
fn occurs(excerpt: &[String], text: &str) -> bool {
    let lines: Vec<String> = text.lines().map(|line| line.trim_end().to_owned()).collect();
    !excerpt.is_empty() && lines.windows(excerpt.len()).any(|window| window == excerpt)
}

/// The words in code of a line.
fn code(line: &str) -> impl Iterator<Item = &str> {
    line.split('`').skip(1).step_by(2)
}

/// Targets of the links of a line.
fn links(line: &str) -> Vec<String> {
    let plain: String = line.split('`').step_by(2).collect();
    let ends = plain.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    ends.map(|(target, _)| target.to_owned()).collect()
}

/// What is wrong with a link of `page`, if anything is.
fn broken(page: &Page, target: &str) -> Option<String> {
    if ["http://", "https://", "mailto:"].iter().any(|scheme| target.starts_with(scheme)) {
        return None;
    }
    let (file, heading) = target.split_once('#').unwrap_or((target, ""));
    let path = if file.is_empty() { page.path.clone() } else { page.path.parent()?.join(file) };
    if !path.exists() {
        return Some(format!("{target}: no such file"));
    }
    if heading.is_empty() || path.extension().is_none_or(|ending| ending != "md") {
        return None;
    }
    let text = fs::read_to_string(&path).unwrap();
    let known = Page { path, text }.anchors().iter().any(|anchor| anchor == heading);
    (!known).then(|| format!("{target}: no such heading"))
}

/// The path that a word in code stands for; patterns stand for none.
fn path(word: &str) -> Option<&str> {
    let pattern = word.contains(['*', '<', '{', '…']);
    let first = word.split([' ', ':', ',']).next()?;
    (!pattern && FOLDERS.iter().any(|folder| first.starts_with(folder))).then_some(first)
}

#[test]
fn excerpts_are_lines_of_their_files() {
    let mut seen = 0;
    let mut wrong = Vec::new();
    for page in pages() {
        for (file, excerpt) in excerpts(&page.text) {
            seen += 1;
            let text = fs::read_to_string(project(&file)).unwrap_or_default();
            if !occurs(&excerpt, &text) {
                wrong.push(format!("{}: not in {file}:\n{}\n", page.name(), excerpt.join("\n")));
            }
        }
    }
    assert!(seen > 20, "only {seen} excerpts were seen");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn an_excerpt_that_differs_is_found() {
    let text =
        "text\n<!-- excerpt: src/lib.rs -->\n```rust\na  \n\nb\n```\n<!-- excerpt: src/main.rs -->\n```\nc\n```\n";
    let found = excerpts(text);
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].0, "src/lib.rs");
    let (first, second) = (&found[0].1, &found[1].1);
    assert!(occurs(first, "x\na\n  \nb \ny"));
    assert!(!occurs(first, "a\nb"), "a line is missing");
    assert!(!occurs(first, "  a\n\nb"), "another indentation");
    assert!(!occurs(first, "a"), "longer than the file");
    assert!(!occurs(&[], "a") && occurs(second, "c"));
}

#[test]
fn links_lead_somewhere() {
    let mut seen = 0;
    let mut wrong = Vec::new();
    for page in pages() {
        for (number, line) in page.prose() {
            for target in links(line) {
                seen += 1;
                wrong.extend(broken(&page, &target).map(|why| format!("{}:{number}: {why}", page.name())));
            }
        }
    }
    assert!(seen > 60, "only {seen} links were seen");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_link_that_leads_nowhere_is_found() {
    let found = links("[one](a.md), `[no](code)` and [`two`](b.md#c), ![three](d.png)");
    assert_eq!(found, ["a.md", "b.md#c", "d.png"]);
    let text = "# One and two: `three`, 4\n\n```text\n# none\n```\n".to_owned();
    let page = Page { path: project("docs/README.md"), text };
    assert_eq!(page.anchors(), ["one-and-two-three-4"]);
    let ends = |target: &str| broken(&page, target).map(|why| why.rsplit_once(' ').unwrap().1.to_owned());
    assert_eq!(ends("SUMMARY.md"), None);
    assert_eq!(ends("../README.md"), None);
    assert_eq!(ends("https://example.org/#x"), None);
    assert_eq!(ends("nowhere.md").as_deref(), Some("file"));
    assert_eq!(ends("SUMMARY.md#nothing-of-the-kind").as_deref(), Some("heading"));
}

#[test]
fn paths_in_code_exist() {
    let mut seen = 0;
    let mut wrong = Vec::new();
    for page in pages() {
        for (number, line) in page.prose() {
            for path in code(line).filter_map(path) {
                seen += 1;
                if !project(path).exists() {
                    wrong.push(format!("{}:{number}: {path}", page.name()));
                }
            }
        }
    }
    assert!(seen > 60, "only {seen} paths were seen");
    assert!(wrong.is_empty(), "no such file:\n{}", wrong.join("\n"));
    assert_eq!(path("src/lib.rs: the map"), Some("src/lib.rs"));
    assert_eq!([path("src/models/<one>/"), path("cargo test")], [None, None]);
}

#[test]
fn every_page_is_in_the_summary() {
    let summary = fs::read_to_string(project("docs/SUMMARY.md")).unwrap();
    let missing: Vec<String> = files(&project("docs"), "md")
        .iter()
        .filter_map(|path| path.strip_prefix(project("docs")).ok().map(|path| path.display().to_string()))
        .filter(|name| name != "SUMMARY.md" && !summary.contains(&format!("({name})")))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn every_verb_is_in_the_readme_and_every_model_in_the_book() {
    let help = Scratch::new().bedload(["--help"]).exits(0).out;
    let verbs = help.split_once("Commands:").unwrap().1.split_once("\n\n").unwrap().0.lines();
    // What begins further in is the rest of a long line.
    let verbs = verbs.filter_map(|line| line.strip_prefix("  ").filter(|rest| !rest.starts_with(' ')));
    let verbs = verbs.filter_map(|line| line.split(' ').next()).filter(|verb| *verb != "help");
    let readme = fs::read_to_string(project("README.md")).unwrap();
    let mut seen = 0;
    for verb in verbs {
        seen += 1;
        assert!(readme.contains(&format!("`{verb}")), "README.md does not have the verb {verb}");
    }
    assert!(seen > 10, "{help}");
    let about = fs::read_to_string(project("docs/README.md")).unwrap();
    for entry in REGISTRY.entries() {
        assert!(about.contains(&format!("| `{}` |", entry.info.name)), "docs/README.md lacks {}", entry.info.name);
    }
}

const BEGIN: &str = "<!-- laws: made by tests/it/docs.rs -->\n";
const END: &str = "<!-- end of laws -->\n";

/// All laws of the catalogue, a row each.
fn laws() -> String {
    let mut text = String::from("| law | equation | source | given for |\n|---|---|---|---|\n");
    for law in catalogue() {
        let ranges: Vec<String> = law.ranges.iter().map(ToString::to_string).collect();
        let standing = if law.standing == Standing::Experimental { ", experimental" } else { "" };
        text += &format!(
            "| `{}/{}`{standing} | `{}` | {} | {} |\n",
            law.family,
            law.law,
            law.equation.replace('|', "\\|"),
            law.source,
            ranges.join("; ")
        );
    }
    text
}

#[test]
fn the_table_of_laws_is_that_of_the_catalogue() {
    let path: &Path = &project("docs/theory.md");
    let page = fs::read_to_string(path).unwrap();
    let (before, rest) = page.split_once(BEGIN).expect("docs/theory.md has a place for the laws");
    let (table, after) = rest.split_once(END).expect("the laws end");
    if table == laws() {
        return;
    }
    if std::env::var_os("BEDLOAD_GOLDENS").is_some_and(|word| word == "write") {
        fs::write(path, format!("{before}{BEGIN}{}{END}{after}", laws())).unwrap();
    } else {
        panic!("out of step; BEDLOAD_GOLDENS=write cargo test --release --test it -- table_of_laws");
    }
}
