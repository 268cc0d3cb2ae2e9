//! Pages of runs: the frames and values of the run.

use pompeiu_coupling::channel::ChannelOptions;
use pompeiu_coupling::piston::PistonOptions;
use pompeiu_coupling::scenario::{RunReport, Scenario};
use pompeiu_coupling::show::{CoupleFrames, CouplePage};
use pompeiu_coupling::tube::TubeOptions;
use pompeiu_coupling::{CouplingOptions, Scheme};
use serde_json::Value;

/// A run, its frames and the data of its page.
fn played(
    kind: &str,
    scenario: &Scenario,
    scheme: Scheme,
    windows: usize,
) -> (RunReport, CoupleFrames, Value) {
    let mut frames = CoupleFrames::default();
    let options = CouplingOptions { scheme, ..CouplingOptions::default() };
    let mut watch = |window: usize, x: &[f64], y: &[f64]| {
        frames.add(window, x, y);
        true
    };
    let run = scenario.run(&options, windows, &mut watch).unwrap();
    let page = CouplePage { kind, scenario, windows, run: &run, frames: frames.frames(), command: None };
    let html = page.html().unwrap();
    let data = html.split_once("id=\"data\">").unwrap().1.split_once("</script>").unwrap().0;
    let data = serde_json::from_str(data).unwrap();
    (run, frames, data)
}

/// All objects with this key and value, at any depth.
fn with<'v>(data: &'v Value, key: &str, value: &str) -> Vec<&'v Value> {
    let mut found = Vec::new();
    let mut open = vec![data];
    while let Some(next) = open.pop() {
        if next.get(key).is_some_and(|v| v == value) {
            found.push(next);
        }
        match next {
            Value::Object(entries) => open.extend(entries.values()),
            Value::Array(entries) => open.extend(entries),
            _ => {}
        }
    }
    found
}

/// The ordinates of a chart.
fn curve(data: &Value, key: &str) -> Vec<f64> {
    let chart = with(data, "key", key)[0];
    chart["series"][0]["y"].as_array().unwrap().iter().map(|y| y.as_f64().unwrap()).collect()
}

fn channel() -> Scenario {
    Scenario::Channel(ChannelOptions { cells: [24, 4], ..ChannelOptions::default() })
}

#[test]
fn the_page_of_a_channel_has_the_frames_solves_and_pressures_of_the_run() {
    let (run, frames, data) = played("channel", &channel(), Scheme::IqnIls, 12);
    let solves: Vec<f64> = run.windows.iter().map(|window| window.solves as f64).collect();
    assert_eq!(curve(&data, "solves"), solves);
    let pressures: Vec<f64> =
        frames.frames().iter().map(|frame| frame.y.iter().fold(0.0, |m: f64, p| m.max(p.abs()))).collect();
    assert!(pressures.iter().all(|p| *p > 0.0));
    assert_eq!(curve(&data, "pressure"), pressures);
    // The fluid and the wall in each frame, the wall alone with values; a step of the player for each.
    assert_eq!(data["meshes"].as_array().unwrap().len(), 2 * 12);
    assert_eq!(data["values"].as_array().unwrap().len(), 12);
    assert_eq!(data["players"][0]["steps"], 12);
    let text = data.to_string();
    assert!(text.contains(&run.added_mass.unwrap().to_string()) && text.contains("\"iqn-ils\""), "{text}");
    assert!(!text.contains("monolithic"));
}

#[test]
fn pages_of_tube_and_piston_say_how_far_they_are_from_both_solved_at_once() {
    let tube = Scenario::Tube(TubeOptions { segments: 1000, ..TubeOptions::default() });
    for (kind, scenario) in [("tube", tube), ("piston", Scenario::Piston(PistonOptions::default()))] {
        let (run, frames, data) = played(kind, &scenario, Scheme::IqnIls, 3);
        assert_eq!(data["meshes"].as_array().unwrap().len(), 3);
        // Not more stations than can be seen, with both ends.
        let count = frames.frames()[0].x.len();
        assert_eq!(count, if kind == "tube" { 400 } else { 1 });
        let text = data.to_string();
        let distance = serde_json::to_string(&run.from_monolithic.unwrap()).unwrap();
        assert!(text.contains("both solved at once (monolithic)") && text.contains(&distance), "{text}");
    }
}

#[test]
fn a_long_run_has_evenly_spaced_frames_and_the_last_window() {
    let piston = Scenario::Piston(PistonOptions::default());
    let (run, frames, data) = played("piston", &piston, Scheme::IqnIls, 300);
    let windows: Vec<usize> = frames.frames().iter().map(|frame| frame.window).collect();
    assert_eq!(windows.len(), 76, "{windows:?}");
    assert!(windows[..75].windows(2).all(|pair| pair[1] - pair[0] == 4) && windows[75] == 300);
    // Solves of the windows between, on average.
    let solves = curve(&data, "solves");
    let mean = run.windows[1..5].iter().map(|window| window.solves as f64).sum::<f64>() / 4.0;
    assert_eq!(solves[1].to_bits(), mean.to_bits());
}

#[test]
fn a_run_without_a_window_has_a_page_that_says_why() {
    let (run, _, data) = played("channel", &channel(), Scheme::Fixed, 2);
    assert!(run.windows.is_empty());
    let failure = run.failure.unwrap();
    assert!(with(&data, "name", "ended").len() == 1 && data.to_string().contains(&failure), "{data}");
}
