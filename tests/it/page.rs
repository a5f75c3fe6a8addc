//! Pages in a browser, headless: they answer to a pointer, play their animation, load nothing and complain of nothing, in light
//! and in dark. Without a Chromium on the path the tests say so and pass.

use std::env;
use std::fs::{self, File};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::support::Scratch;

/// What a reader does, and what the page answers.
const PROBE: &str = include_str!("page.js");
/// Frames by the browser's own clock, which runs ahead of the screen's.
const FRAMES: &str = "requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), 16)";
const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// The browser, or a word that there is none.
fn chromium() -> Option<PathBuf> {
    let path = env::var_os("PATH").unwrap_or_default();
    let found = env::split_paths(&path).flat_map(|folder| NAMES.map(|name| folder.join(name))).find(|p| p.is_file());
    if found.is_none() {
        println!("skipped: no chromium");
    }
    found
}

/// What the browser makes of a file: the page once its scripts have run, and what it says on the console.
fn open(browser: &PathBuf, scratch: &Scratch, file: &str, (dark, wide): (bool, u32)) -> (String, Vec<String>) {
    let (dom, log) = (scratch.path("dom"), scratch.path("log"));
    let scheme = format!("--blink-settings=preferredColorScheme={}", if dark { 0 } else { 1 });
    let mut child = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--hide-scrollbars"])
        .arg(format!("--window-size={wide},1200"))
        .args(["--virtual-time-budget=4000", "--enable-logging=stderr", "--v=0", "--dump-dom", &scheme])
        .arg(format!("--user-data-dir={}", scratch.path("profile").display()))
        .arg(format!("file://{}", scratch.path(file).display()))
        .stdin(Stdio::null())
        .stdout(File::create(&dom).unwrap())
        .stderr(File::create(&log).unwrap())
        .spawn()
        .unwrap();
    let begun = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begun.elapsed() > Duration::from_secs(120) {
            child.kill().unwrap();
            panic!("the browser does not end: {}", String::from_utf8_lossy(&fs::read(&log).unwrap()));
        }
        sleep(Duration::from_millis(20));
    }
    let text = |path| String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned();
    let console = text(&log).lines().filter(|line| line.contains(":CONSOLE")).map(str::to_owned).collect();
    (text(&dom), console)
}

/// Widths of a window, of a desk and of a hand [px].
const WIDE: u32 = 1000;
const NARROW: u32 = 500;

/// The page as it is, then with the probe; both in light and dark, the probe in a narrow window, too.
fn examine(browser: &PathBuf, scratch: &Scratch, file: &str) -> [Value; 3] {
    let page = scratch.read(file);
    let policy = page.split_once("<meta http-equiv=\"Content-Security-Policy\"").unwrap();
    let rest = policy.1.split_once('>').unwrap().1;
    let rest = rest.replace("</body>", &format!("<script>{PROBE}</script></body>"));
    scratch.write("probed.html", format!("{}<script>{FRAMES}</script>{rest}", policy.0));
    [(false, WIDE), (true, WIDE), (true, NARROW)].map(|(dark, wide)| {
        if wide == WIDE {
            let (dom, console) = open(browser, scratch, file, (dark, wide));
            assert!(dom.contains("data-ready=\"true\""), "{file}: the script did not run to its end");
            assert!(console.is_empty(), "{file}: {console:?}");
        }
        let (dom, console) = open(browser, scratch, "probed.html", (dark, wide));
        assert!(console.is_empty(), "{file}: {console:?}");
        let reported = dom.split_once("data-probe=\"").unwrap_or_else(|| panic!("{file}: no answer")).1;
        let reported = reported.split_once('"').unwrap().0.replace("&quot;", "\"").replace("&nbsp;", " ");
        let answer: Value =
            serde_json::from_str(&reported.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&")).unwrap();
        assert_eq!(answer["error"], Value::Null, "{file}");
        assert_eq!(answer["dark"], dark, "{file}");
        assert_eq!(answer["loaded"], 0, "{file}: the page loads something");
        assert_eq!(answer["wide"], false, "{file}: the page scrolls sideways in {wide} px");
        assert_eq!(answer["faults"], Value::Array(Vec::new()), "{file} in {wide} px");
        assert_eq!(answer["ordered"], true, "{file}: not the title, the answer, a figure, the tables");
        assert!(answer["contrast"].as_f64().unwrap() > 7.0, "{file}: {}", answer["contrast"]);
        for plot in answer["plots"].as_array().unwrap() {
            assert!(plot["panels"].as_u64().unwrap() > 0 && plot["curves"].as_u64().unwrap() > 0, "{file}: {plot}");
            assert!(!plot["reported"].as_array().unwrap().is_empty() && plot["left"] == 0, "{file}: {plot}");
            if let Some(legend) = plot["legend"].as_object() {
                let counts: Vec<u64> = legend["counts"].as_array().unwrap().iter().flat_map(Value::as_u64).collect();
                assert!(counts[0] == 0 && counts[1] > 0 && counts[2] == 0, "{file}: {counts:?}");
                assert_eq!(legend["pressed"], "false");
            }
        }
        answer
    })
}

/// The number after `label`, as it is printed, without its unit.
fn number(text: &str, label: &str) -> f64 {
    let rest = text.split_once(label).unwrap_or_else(|| panic!("no {label} in {text}")).1;
    let word = rest.split_whitespace().next().unwrap().replace('−', "-");
    word.parse().unwrap_or_else(|e| panic!("{e}: {word} after {label} in {text}"))
}

#[test]
fn what_a_page_complains_of_is_seen() {
    let Some(browser) = chromium() else { return };
    let scratch = Scratch::new();
    scratch.write("bad.html", "<!DOCTYPE html><script>nobody.home()</script>");
    let (_, console) = open(&browser, &scratch, "bad.html", (false, WIDE));
    assert!(console.len() == 1 && console[0].contains("nobody is not defined"), "{console:?}");
}

#[test]
fn what_cannot_be_read_on_a_page_is_seen() {
    let Some(browser) = chromium() else { return };
    let scratch = Scratch::new();
    let text = |x: i32, words: &str| format!("<text x=\"{x}\" y=\"50\" font-size=\"12\">{words}</text>");
    let curve = |panel: i32, name: &str, end: i32, points: &str| {
        let group = format!(
            "<g class=\"curve\" data-panel=\"{panel}\" data-key=\"{panel}.0\" data-name=\"{name}\" data-points=\"{points}\">"
        );
        format!("{group}<path d=\"M10 10L{end} 20\" stroke=\"#000\"/></g>")
    };
    let pane = "<rect class=\"pane\" x=\"0\" y=\"0\" width=\"400\" height=\"90\" fill=\"none\"/>";
    let drawing = [
        text(20, "pressure"),
        text(40, "velocity"),
        text(780, "beyond"),
        pane.repeat(2),
        curve(0, "long", 700, "1,2 3,4"),
        curve(1, "short", 300, "1,2 3,4"),
        format!("<g class=\"key\" data-key=\"7.0\">{}</g>", text(200, "nothing")),
    ];
    let table = "<table><tr><td>first</td></tr></table>";
    let plot = format!("<svg class=\"plot\" width=\"800\" height=\"100\">{}</svg>", drawing.concat());
    let map = format!("<svg class=\"map\" width=\"800\" height=\"100\">{}</svg>", text(20, "y (m)"));
    scratch.write(
        "bad.html",
        format!("<!DOCTYPE html><h1>t</h1>{table}<figure>{plot}{map}</figure><script>{PROBE}</script>"),
    );
    let (dom, _) = open(&browser, &scratch, "bad.html", (false, WIDE));
    for fault in [
        "velocity lies on pressure",
        "beyond leaves the sheet",
        "long leaves its panel",
        "nothing is not drawn",
        "panel 1 is that of 0",
        "not two axes and a scale with units",
        "ordered&quot;:false",
    ] {
        assert!(dom.contains(fault), "{fault}: {dom}");
    }
    assert!(!dom.contains("short leaves") && !dom.contains("pressure leaves"));
}

#[test]
fn profiles_answer_with_the_values_of_the_table_at_one_elevation_in_all_panels() {
    let Some(browser) = chromium() else { return };
    let scratch = Scratch::new();
    scratch.bedload(["run", "laminar_1d_aussillous", "--out", "out"]).exits(0);
    let answers = examine(&browser, &scratch, "out/report.html");
    let table = scratch.read("out/profile.csv");
    let mut lines = table.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let column = head.iter().position(|name| *name == "u_mixture_m_s").unwrap();
    let rows: Vec<[f64; 2]> = lines.map(|row| [0, column].map(|i| row[i].parse().unwrap())).collect();
    for answer in &answers {
        let plot = &answer["plots"][0];
        let reported = plot["reported"][0].as_str().unwrap();
        let z = 1e-3 * number(reported, "elevation z = ");
        let above = rows.iter().position(|row| row[0] > z).unwrap();
        let [[z0, u0], [z1, u1]] = [rows[above - 1], rows[above]];
        let expected = u0 + (z - z0) / (z1 - z0) * (u1 - u0);
        let u = 1e-3 * number(reported, "mixture");
        assert!((u / expected - 1.0).abs() < 2e-3, "{u} where the table has {expected}");
        // One horizontal line in each panel, all at the same height.
        let crosses = plot["crosses"].as_array().unwrap();
        assert_eq!(crosses.len() as u64, plot["panels"].as_u64().unwrap());
        let height = |cross: &Value| {
            cross.as_str().unwrap().split(['M', 'L', ' ']).nth(2).map(|y| y.parse::<f64>().unwrap()).unwrap()
        };
        assert!(crosses.len() > 2 && crosses.iter().all(|c| (height(c) - height(&crosses[0])).abs() < 1e-6));
    }
    assert!(scratch.read("out/report.html").len() < 200_000);
}

#[test]
fn grains_move_while_the_animation_plays_and_stop_when_it_is_paused() {
    let Some(browser) = chromium() else { return };
    let scratch = Scratch::new();
    scratch.bedload(["run", "grains_3d_bed_quick", "--out", "out", "--quiet"]).exits(0);
    let recorded: Value = serde_json::from_str(&scratch.read("out/motion.json")).unwrap();
    let get = |name: &str| recorded[name].as_f64().unwrap();
    let end = get("begin_s") + get("interval_s") * (get("pictures") - 1.0);
    for answer in examine(&browser, &scratch, "out/report.html") {
        let animation = &answer["animation"];
        let time = |name: &str| number(animation[name].as_str().unwrap(), "t = ");
        assert!((time("begin") - time("later")).abs() > 0.0, "it does not play: {animation}");
        assert!((time("end") - end).abs() < 1e-3, "{animation}: {end} s");
        assert_eq!((&animation["reported"], &animation["still"]), (&Value::from("Play"), &Value::from(true)));
        assert!(animation["colours"].as_u64().unwrap() > 50, "the canvas is empty: {animation}");
        assert_eq!((&animation["hidden"], &animation["drawing"]), (&Value::from(false), &Value::from(true)));
    }
    assert!(scratch.read("out/report.html").len() < 3_000_000);
}

#[test]
fn pages_of_studies_and_comparisons_answer_too() {
    let Some(browser) = chromium() else { return };
    let scratch = Scratch::new();
    let sweep = ["sweep", "exact_1d_aussillous", "--over", "flow.pressure_gradient=60:180:5 Pa/m", "--out", "sweep"];
    scratch.bedload(sweep).exits(0);
    scratch.bedload(["chart", "bed_ouriemi-laminar", "bed_ouriemi-laminar-exact", "--out", "chart"]).exits(0);
    scratch.bedload(["compare", "bed_ouriemi-laminar-exact", "exact_1d_ouriemi_mixed", "--out", "compare"]).exits(0);
    // Each of these had something that could not be read: an axis twice, a legend of nothing, titles on each other, no limit.
    scratch.bedload(["sweep", "sheet_1d_type_b", "--over", "flow.shields=0.4:1:3", "--out", "shields"]).exits(0);
    scratch.bedload(["chart", "bed_ouriemi", "--out", "chart-models"]).exits(0);
    scratch.bedload(["compare", "sheet_1d_sumer91", "sheet_1d_sumer82", "--out", "compare-sheets"]).exits(0);
    let stability =
        ["stability", "exact_1d_aussillous", "--over", "flow.pressure_gradient=60:6000:4 Pa/m", "--out", "stability"];
    scratch.bedload(stability).exits(0);
    let all = ["sweep", "chart", "compare", "shields", "chart-models", "compare-sheets", "stability"];
    for folder in all {
        let file = format!("{folder}/report.html");
        for answer in examine(&browser, &scratch, &file) {
            assert!(!answer["plots"].as_array().unwrap().is_empty(), "{file}");
            let linked = answer["plots"][0]["reported"][0].as_str().unwrap().contains("elevation z = ");
            assert_eq!(linked, folder.starts_with("compare"), "{file}: {}", answer["plots"][0]);
        }
        assert!(scratch.read(&file).len() < 200_000, "{file}");
    }
}

#[test]
fn a_map_of_a_section_has_axes_and_a_scale() {
    let Some(browser) = chromium() else { return };
    let scratch = Scratch::new();
    for case in ["section_2d_square", "section_2d_square_bed", "section_2d_cavity_bn5"] {
        scratch.bedload(["run", case, "--out", case]).exits(0);
        for answer in examine(&browser, &scratch, &format!("{case}/report.html")) {
            assert_eq!(answer["maps"], 1, "{case}");
        }
    }
}
