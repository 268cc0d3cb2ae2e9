//! The page that a program serves, asked by plain TCP: who is refused, what is answered, when it ends.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

use pompeiu::core::run::CancelToken;
use pompeiu_web::{App, Engine, Silent};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// An address that is served while `work` runs.
fn served(work: impl FnOnce(&Place)) {
    served_with(Vec::new(), work);
}

/// The same with files that the page compares at first.
fn served_with(files: Vec<PathBuf>, work: impl FnOnce(&Place)) {
    let app = App::bind(0, files).unwrap();
    let place = Place::of(&app);
    let token = CancelToken::default();
    std::thread::scope(|scope| {
        scope.spawn(|| app.run(&token));
        let _ends = Ends(&token);
        work(&place);
    });
}

/// Ends the server also where a test fails, which waits for it.
struct Ends<'t>(&'t CancelToken);

impl Drop for Ends<'_> {
    fn drop(&mut self) {
        self.0.cancel();
    }
}

struct Place {
    host: String,
    secret: String,
}

/// A response: its status and its body.
type Response = (u16, Vec<u8>);

impl Place {
    fn of(app: &App) -> Self {
        let address = app.address();
        let (host, secret) = address.strip_prefix("http://").unwrap().split_once('/').unwrap();
        Self { host: host.to_owned(), secret: secret.trim_end_matches('/').to_owned() }
    }

    fn send(&self, request: &str, body: &[u8]) -> TcpStream {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(Duration::from_mins(2))).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        stream.write_all(body).unwrap();
        stream
    }

    fn ask(&self, method: &str, path: &str, headers: &str, body: &[u8]) -> Response {
        let length = body.len();
        let head = format!(
            "{method} {path} HTTP/1.1\r\n{headers}Content-Length: {length}\r\nConnection: close\r\n\r\n"
        );
        let mut all = Vec::new();
        self.send(&head, body).read_to_end(&mut all).unwrap();
        let end = all.windows(4).position(|four| four == b"\r\n\r\n").unwrap();
        let status = String::from_utf8_lossy(&all[..end]).split(' ').nth(1).unwrap().parse().unwrap();
        (status, all[end + 4..].to_vec())
    }

    fn own(&self, method: &str, path: &str, body: &[u8]) -> Response {
        let headers = format!("Host: {0}\r\nOrigin: http://{0}\r\n", self.host);
        self.ask(method, &format!("/{}/{path}", self.secret), &headers, body)
    }

    /// A call of a page.
    fn call(&self, number: u64, call: &Value, arrays: &[&[u8]]) -> Value {
        let call = call.to_string();
        let all: Vec<&[u8]> = std::iter::once(call.as_bytes()).chain(arrays.iter().copied()).collect();
        let lengths: Vec<usize> = all.iter().map(|array| array.len()).collect();
        let body = [format!("{lengths:?}\n").as_bytes(), &all.concat()].concat();
        let (status, body) = self.own("POST", &format!("call/one/{number}"), &body);
        assert_eq!(status, 200, "{}", String::from_utf8_lossy(&body));
        let end = body.iter().position(|byte| *byte == b'\n').unwrap();
        let lengths: Vec<usize> = serde_json::from_slice(&body[..end]).unwrap();
        serde_json::from_slice(&body[end + 1..][..lengths[0]]).unwrap()
    }
}

/// A bumpy square of 2n² faces at a height, as a PLY file.
fn bumps(n: usize, height: f64) -> Vec<u8> {
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        (n + 1) * (n + 1),
        2 * n * n
    );
    for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
        let z = height + 0.3 * ((i * 7 + j * 13) % 5) as f64;
        let _ = writeln!(text, "{i} {j} {z}");
    }
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let [a, b, c, d] =
            [i * (n + 1) + j, i * (n + 1) + j + 1, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1];
        let _ = writeln!(text, "3 {a} {c} {b}\n3 {b} {c} {d}");
    }
    text.into_bytes()
}

#[test]
fn who_is_not_the_page_is_refused() {
    served(|place| {
        let (host, secret) = (&place.host, &place.secret);
        let port = host.rsplit(':').next().unwrap();
        let own = format!("Host: {host}\r\n");
        let get = |path: &str, headers: &str| place.ask("GET", path, headers, b"").0;
        let page = format!("/{secret}/");
        assert_eq!(get(&page, &own), 200);
        assert_eq!(get(&page, &format!("{own}Origin: http://{host}\r\n")), 200);
        for headers in [
            // DNS rebinding: a name of another page for this address.
            format!("Host: rebound.example:{port}\r\n"),
            format!("Host: localhost:{port}\r\n"),
            "Host: 127.0.0.1\r\n".to_owned(),
            String::new(),
            format!("{own}Host: rebound.example\r\n"),
            format!("{own}Origin: http://rebound.example:{port}\r\n"),
            format!("{own}Origin: null\r\n"),
            format!("{own}Origin: https://{host}\r\n"),
        ] {
            assert_eq!(get(&page, &headers), 403, "{headers}");
        }
        let wrong = secret.replace(|digit: char| digit.is_ascii_digit(), "a");
        for path in [
            "/".to_owned(),
            format!("/{}/", &secret[1..]),
            format!("/{wrong}/"),
            format!("/{secret}"),
            String::from("/../"),
        ] {
            assert_eq!(get(&path, &own), 403, "{path}");
        }
        for path in ["file/0", "file/../../etc/passwd", "told/nobody", "call/one/1"] {
            assert_eq!(get(&format!("{page}{path}"), &own), 404, "{path}");
        }
        let (status, body) = place.own("POST", "call/one/1", b"[18446744073709551615]\nx");
        assert_eq!(status, 400, "{}", String::from_utf8_lossy(&body));
        assert_eq!(place.own("POST", "call/one/many", b"[0]\n").0, 400);
        assert_eq!(place.own("POST", &format!("alive/{}", "x".repeat(65)), b"").0, 429);
    });
}

#[test]
fn the_page_has_no_mark_left_and_connects_to_its_server_alone() {
    served_with(vec![PathBuf::from("folder/a<b.obj")], |place| {
        let (status, page) = place.own("GET", "", b"");
        let page = String::from_utf8(page).unwrap();
        assert!(status == 200 && page.contains("connect-src 'self'"));
        assert!(!page.contains("wasm-unsafe-eval"));
        for mark in ["STYLE", "MODULE", "EXAMPLES", "WORKER", "SERVED", "SCRIPT"] {
            assert!(!page.contains(&format!("/*{mark}*/")), "{mark}");
        }
        let served = page.split("id=\"served\">").nth(1).unwrap().split("</script>").next().unwrap();
        let served: Value = serde_json::from_str(served).unwrap();
        assert_eq!(served["files"][0], "a<b.obj");
    });
}

#[test]
fn a_body_has_exactly_the_arrays_that_it_names() {
    served(|place| {
        let status = |body: &[u8]| place.own("POST", "call/one/1", body).0;
        // A call, an empty array, and one of line breaks.
        let body = b"[2,0,3]\n{}\n\n\n";
        assert_eq!(status(body), 200);
        assert_eq!(status(&body[..body.len() - 1]), 400);
        assert_eq!(status(&[&body[..], b"x"].concat()), 400);
        for wrong in ["", "[1]", "[-1]\n", "[18446744073709551615]\nx", "[9999999999]\nx", "{}\n", "[1,\n"] {
            assert_eq!(status(wrong.as_bytes()), 400, "{wrong}");
        }
    });
}

#[test]
fn a_body_that_does_not_come_holds_up_nobody() {
    served(|place| {
        let (host, secret) = (&place.host, &place.secret);
        for length in ["4000000000", "18446744073709551615", "-1", "many"] {
            let head = format!(
                "POST /{secret}/call/one/1 HTTP/1.1\r\nHost: {host}\r\nContent-Length: {length}\r\n\r\n"
            );
            let _open = place.send(&head, b"[2]\n");
            let _half = place.send("GET /", b"");
            assert_eq!(place.own("GET", "", b"").0, 200);
        }
    });
}

#[test]
fn answers_are_those_of_the_engine() {
    served(|place| {
        let files = [bumps(12, 0.0), bumps(9, 0.7)];
        let ask = json!({ "call": "ask", "command": "distance", "meshes": [1, 2] });
        let mut engine = Engine::default();
        for (i, file) in files.iter().enumerate() {
            let read = json!({ "call": "read", "name": format!("{i}.ply") });
            let facts = place.call(i as u64 + 1, &read, &[file]);
            let here = engine.call(&read.to_string(), vec![file.clone()], &Silent);
            assert_eq!(facts.to_string(), here.json);
        }
        let served = place.call(3, &ask, &[]);
        let here: Value =
            serde_json::from_str(&engine.call(&ask.to_string(), Vec::new(), &Silent).json).unwrap();
        let upper = |reply: &Value| reply["answer"]["report"]["hausdorff"]["upper"].as_f64().unwrap();
        assert!(upper(&here) > 0.0);
        // But for times.
        for part in ["hausdorff", "a_to_b", "b_to_a"] {
            let bounds = |reply: &Value| reply["answer"]["report"][part]["lower"].clone();
            assert_eq!(bounds(&served), bounds(&here), "{part}");
        }
        assert_eq!(upper(&served).to_bits(), upper(&here).to_bits());
        let wrong = place.call(4, &json!({ "call": "ask", "command": "info", "meshes": [7] }), &[]);
        assert_eq!(wrong["error"], "there is no mesh 7; read it first");
    });
}

#[test]
fn a_call_that_is_cancelled_ends_with_what_it_has() {
    served(|place| {
        for (i, file) in [bumps(150, 0.0), bumps(149, 0.7)].iter().enumerate() {
            place.call(i as u64 + 1, &json!({ "call": "read", "name": "bumps.ply" }), &[file]);
        }
        let ask = json!({ "call": "ask", "command": "deviation", "meshes": [1, 2], "options": { "accuracy": 1e-9 } });
        std::thread::scope(|scope| {
            let answer = scope.spawn(|| place.call(3, &ask, &[]));
            while place.own("GET", "told/one", b"").1 == b"null" {
                std::thread::sleep(Duration::from_millis(5));
            }
            assert_eq!(place.own("POST", "cancel/one/3", b"").0, 204);
            let answer = answer.join().unwrap();
            assert_eq!(answer["answer"]["stop"], "cancelled", "{}", answer["error"]);
            assert_eq!(answer["exit_code"], 3);
        });
    });
}

#[test]
fn it_ends_when_the_last_page_is_closed_and_not_before() {
    let app = App::bind(0, Vec::new()).unwrap();
    let place = Place::of(&app);
    let token = CancelToken::default();
    std::thread::scope(|scope| {
        let running = scope.spawn(|| app.run(&token));
        let _ends = Ends(&token);
        for page in ["one", "two"] {
            assert_eq!(place.own("POST", &format!("alive/{page}"), b"").0, 204);
        }
        assert_eq!(place.own("POST", "bye/one", b"").0, 204);
        // Loaded again, on a slow machine: the new page is sent, the old one leaves, the new one runs.
        assert_eq!(place.own("GET", "", b"").0, 200);
        assert_eq!(place.own("POST", "bye/two", b"").0, 204);
        std::thread::sleep(Duration::from_millis(3500));
        assert!(!running.is_finished(), "a page is on its way");
        assert_eq!(place.own("POST", "alive/three", b"").0, 204);
        std::thread::sleep(Duration::from_millis(3500));
        assert!(!running.is_finished(), "a page is open");
        let left = Instant::now();
        assert_eq!(place.own("POST", "bye/three", b"").0, 204);
        running.join().unwrap();
        assert!(left.elapsed() > Duration::from_secs(2), "there is time to load a page again");
    });
}
