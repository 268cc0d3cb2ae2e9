//! Moving pictures of runs.

use crate::common::Folder;

const FLOW: &str = "fluid --square 8 --lid 1 --viscosity 0.1 --steps 3 --dt 0.05 --image-size 96x64 --quiet";

fn count(bytes: &[u8], part: &[u8]) -> usize {
    bytes.windows(part.len()).filter(|window| *window == part).count()
}

#[test]
fn runs_become_moving_pictures() {
    let folder = Folder::new();
    for (suffix, start) in [("apng", &b"\x89PNG"[..]), ("gif", b"GIF89a")] {
        folder.ok(&format!("{FLOW} --video run.{suffix}"));
        let bytes = std::fs::read(folder.path().join(format!("run.{suffix}"))).unwrap();
        assert!(bytes.starts_with(start), "{suffix}");
    }
    let bytes = std::fs::read(folder.path().join("run.apng")).unwrap();
    assert_eq!(count(&bytes, b"fcTL"), 4, "the start and three steps");
    folder.ok("contact stack --steps 2 --video stack.apng --quiet");
    let bytes = std::fs::read(folder.path().join("stack.apng")).unwrap();
    assert_eq!(count(&bytes, b"fcTL"), 3);
}

#[test]
fn what_is_no_film_is_refused_before_the_run() {
    let folder = Folder::new();
    for command in [FLOW, "contact stack --steps 1000000"] {
        let output = folder.pompeiu(&format!("{command} --video run.mp4")).env("PATH", "").output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("run.mp4: films are made by ffmpeg, which is not installed"), "{said}");
        let (code, _, said) = folder.transcript(&format!("{command} --video run.avi"));
        assert!(code == Some(2) && said.contains("moving pictures are pages (.html)"), "{said}");
    }
    let (code, _, said) = folder.transcript("couple channel.toml --video run.gif");
    assert!(code == Some(2) && said.contains("pages are HTML"), "{said}");
}

/// A program of the encoder's name that stores what it gets.
#[cfg(unix)]
#[test]
fn the_encoder_gets_every_picture() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    let encoder = |script: &str| {
        let tools = folder.path().join("tools");
        std::fs::create_dir_all(&tools).unwrap();
        let path = tools.join("ffmpeg");
        std::fs::write(&path, script).unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
        let paths = std::env::var_os("PATH").unwrap_or_default();
        let paths = std::iter::once(tools).chain(std::env::split_paths(&paths).collect::<Vec<_>>());
        let paths = std::env::join_paths(paths).unwrap();
        let output = folder.pompeiu(&format!("{FLOW} --video run.mp4")).env("PATH", paths).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let stores =
        "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\nfor out; do :; done\necho \"$@\" >args\ncat >\"$out\"\n";
    assert_eq!(encoder(stores), (Some(0), String::new()));
    let film = std::fs::read(folder.path().join("run.mp4")).unwrap();
    assert_eq!(film.len(), 4 * 3 * 96 * 64, "pixels of four pictures");
    let args = std::fs::read_to_string(folder.path().join("args")).unwrap();
    assert!(args.contains("-video_size 96x64 -framerate 12.5"), "{args}");
    // After a failure the film that was there is as it was.
    let fails =
        "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\ncat >/dev/null\necho 'no such codec' >&2\nexit 3\n";
    let (code, said) = encoder(fails);
    assert!(code == Some(2) && said.contains("no such codec; write .apng or .gif instead"), "{said}");
    assert_eq!(std::fs::read(folder.path().join("run.mp4")).unwrap(), film);
    let left =
        std::fs::read_dir(folder.path()).unwrap().filter_map(Result::ok).map(|entry| entry.file_name());
    assert!(left.filter(|name| name.to_string_lossy().starts_with('.')).count() == 0, "nothing is left over");
}
