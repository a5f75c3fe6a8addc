//! Every bad case gets exactly the diagnostics that it names in its `#^` lines, exit code 2, and nothing is written.
//!
//! `#^ CODE PATH [line N]: fragment | fragment`: the code and the dotted path (`-` for none, control characters as `\x1b`)
//! as in the answer of `--json`, the line, and pieces of the message, of what is allowed or of the hint.

use std::fs::{self, File};
use std::path::Path;

use serde_json::Value;

use crate::support::{Scratch, files, project};

#[derive(Debug)]
struct Expected {
    code: String,
    path: String,
    line: Option<u64>,
    fragments: Vec<String>,
}

impl Expected {
    fn parse(text: &str) -> Self {
        let (place, fragments) = text.split_once(": ").unwrap_or_else(|| panic!("no `: ` in {text}"));
        let words: Vec<&str> = place.split(' ').collect();
        let (code, path, line) = match *words.as_slice() {
            [code, path] => (code, path, None),
            [code, path, "line", line] => (code, path, Some(line.parse().unwrap())),
            _ => panic!("not CODE PATH [line N]: {place}"),
        };
        let fragments = fragments.split(" | ").map(str::to_owned).collect();
        Self { code: code.into(), path: path.into(), line, fragments }
    }

    fn of(text: &str) -> Vec<Self> {
        text.lines().filter_map(|line| line.strip_prefix("#^ ")).map(Self::parse).collect()
    }

    /// What is wrong with `error` as this diagnostic, if anything.
    fn mismatch(&self, error: &Value) -> Option<String> {
        if self.code != error["code"] || self.path != path(error) {
            return Some(format!("{} {} is another diagnostic", error["code"], path(error)));
        }
        if self.line.is_some() && self.line != error["line"].as_u64() {
            return Some(format!("it is in line {}", error["line"]));
        }
        let text = |key: &str| error[key].as_str().unwrap_or_default().to_owned();
        let said = [text("message"), text("allowed"), text("hint")];
        let missing = self.fragments.iter().find(|f| !said.iter().any(|s| s.contains(f.as_str())))?;
        Some(format!("\"{missing}\" is not in {said:?}"))
    }
}

fn path(error: &Value) -> String {
    let escaped = |c: char| if c.is_control() { format!("\\x{:02x}", c as u32) } else { c.into() };
    error["path"].as_str().map_or_else(|| "-".into(), |path| path.chars().map(escaped).collect())
}

/// What is wrong with how `file` is refused.
fn examine(scratch: &Scratch, file: &Path, mut expected: Vec<Expected>) -> Vec<String> {
    let mut wrong = Vec::new();
    let mut require = |holds: bool, what: &dyn Fn() -> String| {
        if !holds {
            wrong.push(format!("{}: {}", file.file_name().unwrap().display(), what()));
        }
    };
    let file_name = file.to_str().unwrap();
    let json = scratch.bedload(["check", file_name, "--json"]);
    require(json.code == 2, &|| format!("check --json exits {}", json.code));
    require(json.err.is_empty(), &|| format!("check --json says on standard error: {}", json.err));
    let answer = json.json();
    require(answer["status"] == "failed" && answer["error"] == answer["errors"][0], &|| format!("answer {answer}"));
    require(!expected.is_empty(), &|| "no #^ line".into());
    for error in answer["errors"].as_array().unwrap() {
        match expected.iter().position(|e| e.mismatch(error).is_none()) {
            Some(i) => {
                expected.remove(i);
            }
            None => require(false, &|| format!("unexpected: {error}")),
        }
    }
    for missing in &expected {
        require(false, &|| format!("missing: {missing:?}"));
    }

    let text = scratch.bedload(["check", file_name]);
    let run = scratch.bedload(["run", file_name, "--out", "never"]);
    for (verb, said) in [("check", &text), ("run", &run)] {
        require(said.code == 2, &|| format!("{verb} exits {}", said.code));
        require(said.out.is_empty(), &|| format!("{verb} says on standard output: {}", said.out));
        let control = said.err.chars().find(|&c| c.is_control() && !matches!(c, '\n' | '\t'));
        require(control.is_none(), &|| format!("{verb} writes {control:?} to the terminal"));
        require(said.err.len() < 40_000, &|| format!("{verb} says {} bytes", said.err.len()));
        for error in answer["errors"].as_array().unwrap() {
            let code = error["code"].as_str().unwrap();
            require(said.err.contains(code), &|| format!("{verb} does not say {code}: {}", said.err));
        }
    }
    require(!scratch.path("never").exists(), &|| "run wrote its folder".into());
    require(scratch.names(".").iter().all(|name| !name.starts_with('.') && name != "runs"), &|| {
        format!("run left {:?}", scratch.names("."))
    });
    wrong
}

#[test]
fn each_bad_case_gets_exactly_its_diagnostics() {
    let scratch = Scratch::new();
    let cases = files(&project("tests/cases_bad"), "toml");
    assert!(cases.len() >= 100, "only {} bad cases", cases.len());
    let wrong: Vec<String> = cases
        .iter()
        .flat_map(|file| {
            let text = String::from_utf8_lossy(&fs::read(file).unwrap()).into_owned();
            examine(&scratch, file, Expected::of(&text))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn files_that_cannot_carry_a_comment() {
    let scratch = Scratch::new();
    let template = "[case]\ntitle = \"";
    let cases: [(&str, Vec<u8>, &str); 8] = [
        ("empty.toml", Vec::new(), "empty -: the case is empty | `bedload new`"),
        ("blank.toml", b" \n\t\n\r\n".to_vec(), "empty -: the case is empty"),
        ("mark.toml", b"\xef\xbb\xbf".to_vec(), "empty -: the case is empty"),
        ("zeros.toml", vec![0; 4096], "binary -: byte 0 is 0"),
        ("elf.toml", b"\x7fELF\x02\x01\x01\x00\x00".to_vec(), "binary -: byte 7 is 0"),
        ("png.toml", b"\x89PNG\r\n\x1a\n".to_vec(), "not-utf8 -: byte 0 is not"),
        ("utf16.toml", "format = 1\n".encode_utf16().flat_map(u16::to_le_bytes).collect(), "binary -: byte 1 is 0"),
        ("cut.toml", [template.as_bytes(), &[0xc3]].concat(), "not-utf8 -: byte 16 is not"),
    ];
    for (name, content, expected) in cases {
        scratch.write(name, content);
        let wrong = examine(&scratch, &scratch.path(name), vec![Expected::parse(expected)]);
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }
}

#[test]
fn a_hundred_megabytes_are_refused_at_once() {
    let scratch = Scratch::new();
    scratch.write("large.toml", "format = 1\n");
    File::options().write(true).open(scratch.path("large.toml")).unwrap().set_len(100_000_000).unwrap();
    let start = std::time::Instant::now();
    let expected = vec![Expected::parse("too-large -: larger than 1048576 bytes | at most 1048576 bytes")];
    let wrong = examine(&scratch, &scratch.path("large.toml"), expected);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(start.elapsed().as_secs_f64() < 60.0, "{:?}", start.elapsed());
}

#[test]
fn a_file_of_nothing_but_errors_is_refused_in_seconds() {
    let scratch = Scratch::new();
    let base = fs::read_to_string(project("cases/exact_1d_aussillous.toml")).unwrap();
    let keys: String = (0..60_000).map(|i| format!("k{i} = 1\n")).collect();
    for (name, content) in [
        ("lines.toml", base.clone() + &"a\n".repeat(300_000)),
        ("duplicates.toml", base.clone() + &"a = 1\n".repeat(150_000)),
        ("keys.toml", base.replace("[flow]\n", &format!("[flow]\n{keys}"))),
        ("name.toml", base.replace("[flow]\n", &format!("[flow]\n{} = 1\n", "k".repeat(900_000)))),
        ("unit.toml", base.replace("\"32.76 mm\"", &format!("\"32.76 {}\"", "m".repeat(900_000)))),
    ] {
        scratch.write(name, content);
        let start = std::time::Instant::now();
        let answer = scratch.bedload(["check", name]).exits(2);
        assert!(answer.err.len() < 100_000, "{name}: {} bytes", answer.err.len());
        assert!(start.elapsed().as_secs_f64() < 120.0, "{name}: {:?}", start.elapsed());
    }
}

#[test]
fn a_text_says_the_line_a_caret_the_range_and_the_nearest_key() {
    let scratch = Scratch::new();
    let file = project("tests/cases_bad/several_at_once.toml");
    let said = scratch.bedload(["check", file.to_str().unwrap()]).exits(2).err;
    for piece in
        ["densty = \"1190 kg/m3\"", "did you mean \"density\"?", "allowed: more than 0 and at most 0.7405", "here"]
    {
        assert!(said.contains(piece), "{piece} is not in\n{said}");
    }
}
