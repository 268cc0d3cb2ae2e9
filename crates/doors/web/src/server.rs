//! The page served on the loopback interface, with this program as its engine.
//!
//! Who may ask: requests whose path begins with a secret of 128 random bits, which only the address has that the browser is opened
//! with, whose `Host` is the address itself, so that another name for it (DNS rebinding) does not do, and whose `Origin`, where there
//! is one, is the page. All others get 403 before their body is read. Nothing is written to any file.

use crate::frame::{framed, unframed};
use crate::{Engine, Told, Watcher};
use pompeiu::core::request::hexadecimal;
use pompeiu::core::run::CancelToken;
use serde_json::json;
use std::collections::BTreeMap;
use std::io::Read;
use std::net::{Ipv4Addr, SocketAddr};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tiny_http::{Header, Method, Request, Response, Server};

/// How often it is looked whether to end.
const TICK: Duration = Duration::from_millis(100);

/// Time from the closing of the last page to the end: enough to load a page again.
const GRACE: Duration = Duration::from_secs(3);

/// Time in which a page that was sent must say that it is open. A page that is loaded again is closed when its successor arrives, which
/// a slow machine takes longer to run than the page that was closed is waited for.
const LOADING: Duration = Duration::from_secs(30);

/// A page that was not heard of for so long is closed. Pages report every 20 seconds, those in the background at least every minute.
const SILENCE: Duration = Duration::from_mins(3);

/// Largest number of pages that are open at once.
const MOST_PAGES: usize = 16;

/// Longest body of a request, in bytes.
const MOST_BODY: u64 = 64 << 30;

/// Longest name of a page.
const MOST_NAME: usize = 64;

const INDEX: &str = include_str!("../page/index.html");
const STYLE: &str = include_str!("../page/style.css");
const SCRIPTS: [&str; 3] =
    [include_str!("../page/engines.js"), include_str!("../page/tasks.js"), include_str!("../page/page.js")];

/// What the page may do where it is a file; the worker and the module are not there where it is served.
const POLICY_OF_FILE: &str = "script-src 'unsafe-inline' 'wasm-unsafe-eval'; worker-src blob:;";
const POLICY: &str = "script-src 'unsafe-inline'; connect-src 'self';";

/// Why the page cannot be served.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AppError {
    /// No socket.
    #[error(
        "the page cannot be served at 127.0.0.1:{port}: {reason}; leave out the port, and a free one is taken"
    )]
    Bind {
        /// The port that was asked for; 0 for any.
        port: u16,
        /// What the system says.
        reason: String,
    },
    /// No random numbers.
    #[error("the system gives no random numbers for the address of the page: {0}")]
    Random(getrandom::Error),
}

/// The page with this program as its engine, at an address of its own.
///
/// # Example
/// ```
/// use pompeiu::core::run::CancelToken;
/// use pompeiu_web::App;
///
/// let app = App::bind(0, Vec::new())?;
/// assert!(app.address().starts_with("http://127.0.0.1:"));
/// let token = CancelToken::default();
/// token.cancel();
/// app.run(&token);
/// # Ok::<(), pompeiu_web::AppError>(())
/// ```
pub struct App {
    server: Server,
    place: SocketAddr,
    shared: Arc<Shared>,
}

struct Shared {
    secret: String,
    host: String,
    files: Vec<PathBuf>,
    pages: Mutex<BTreeMap<String, Arc<Page>>>,
    /// When a page was sent that has not said yet that it is open.
    sent: Mutex<Option<Instant>>,
}

/// A page that is open.
struct Page {
    engine: Mutex<Engine>,
    /// What was told last of the call that is answered.
    told: Mutex<Option<String>>,
    /// The greatest number of a call that was cancelled, and what cancels the one that is answered.
    cancelled: Mutex<(u64, CancelToken)>,
    seen: Mutex<Instant>,
}

impl Page {
    /// Cancels the calls up to a number, also those that are still to come.
    fn cancel(&self, number: u64) {
        let mut cancelled = lock(&self.cancelled);
        cancelled.0 = cancelled.0.max(number);
        cancelled.1.cancel();
    }
}

/// Watches a call of a page.
struct Watching<'p> {
    page: &'p Page,
    token: CancelToken,
}

impl Watcher for Watching<'_> {
    fn told(&self, told: &Told<'_>) -> ControlFlow<()> {
        *lock(&self.page.told) = serde_json::to_string(told).ok();
        ControlFlow::Continue(())
    }

    fn cancel(&self) -> Option<CancelToken> {
        Some(self.token.clone())
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl App {
    /// Takes a port of the loopback interface, any free one for 0. The page begins with these files.
    ///
    /// # Errors
    /// [`AppError`] if the port is taken, or there are no random numbers.
    pub fn bind(port: u16, files: Vec<PathBuf>) -> Result<Self, AppError> {
        let failed = |reason: String| AppError::Bind { port, reason };
        let server = Server::http(SocketAddr::from((Ipv4Addr::LOCALHOST, port)))
            .map_err(|error| failed(error.to_string()))?;
        let place = server.server_addr().to_ip().ok_or_else(|| failed("it has no address".to_owned()))?;
        let mut secret = [0; 16];
        getrandom::fill(&mut secret).map_err(AppError::Random)?;
        let shared = Shared {
            secret: hexadecimal(&secret),
            host: place.to_string(),
            files,
            pages: Mutex::default(),
            sent: Mutex::default(),
        };
        Ok(Self { server, place, shared: Arc::new(shared) })
    }

    /// Where the page is.
    pub fn address(&self) -> String {
        format!("http://{}/{}/", self.place, self.shared.secret)
    }

    /// Serves until the last page is closed, or it is cancelled.
    pub fn run(&self, token: &CancelToken) {
        let mut last_open: Option<Instant> = None;
        while !token.is_cancelled() {
            if let Ok(Some(request)) = self.server.recv_timeout(TICK) {
                let shared = Arc::clone(&self.shared);
                // A client that does not send what it announces holds up nobody else.
                std::thread::spawn(move || shared.answer(request));
            }
            let mut pages = lock(&self.shared.pages);
            pages.retain(|_, page| lock(&page.seen).elapsed() < SILENCE);
            let is_loading = lock(&self.shared.sent).is_some_and(|at| at.elapsed() < LOADING);
            if !pages.is_empty() {
                last_open = Some(Instant::now());
            } else if !is_loading && last_open.is_some_and(|at| at.elapsed() > GRACE) {
                break;
            }
        }
        for page in lock(&self.shared.pages).values() {
            page.cancel(u64::MAX);
        }
    }
}

/// A status and a body with its type.
type Said = (u16, Vec<u8>, &'static str);

fn text(status: u16, text: &str) -> Said {
    (status, text.as_bytes().to_vec(), "text/plain; charset=utf-8")
}

impl Shared {
    fn answer(&self, mut request: Request) {
        let (status, body, kind) = match self.path_of(&request) {
            Some(path) => self.reply(&path, &mut request),
            None => text(403, "this address belongs to another page"),
        };
        let mut response =
            Response::from_data(body).with_status_code(status).with_chunked_threshold(usize::MAX);
        for (name, value) in [
            ("Content-Type", kind),
            ("Cache-Control", "no-store"),
            ("Referrer-Policy", "no-referrer"),
            ("X-Content-Type-Options", "nosniff"),
            ("X-Frame-Options", "DENY"),
            ("Cross-Origin-Resource-Policy", "same-origin"),
        ] {
            if let Ok(header) = Header::from_bytes(name, value) {
                response.add_header(header);
            }
        }
        // A page that was closed does not get its answer.
        let _ = request.respond(response);
    }

    /// The path after the secret, of a request that may ask.
    fn path_of(&self, request: &Request) -> Option<String> {
        let values = |name: &'static str| {
            let of = request.headers().iter().filter(move |header| header.field.equiv(name));
            of.map(|header| header.value.as_str())
        };
        let is_here = values("Host").eq([self.host.as_str()]);
        let origin = format!("http://{}", self.host);
        let is_own = values("Origin").all(|value| value == origin);
        let path = request.url().strip_prefix('/')?.strip_prefix(&self.secret)?.strip_prefix('/')?;
        (is_here && is_own).then(|| path.to_owned())
    }

    fn reply(&self, path: &str, request: &mut Request) -> Said {
        let parts: Vec<&str> = path.split('/').collect();
        match (request.method(), &parts[..]) {
            (Method::Get, [""]) => {
                *lock(&self.sent) = Some(Instant::now());
                (200, self.page().into_bytes(), "text/html; charset=utf-8")
            }
            (Method::Get, ["file", index]) => self.file(index),
            (Method::Get, ["told", page]) => match self.open(page) {
                Some(page) => {
                    let told = lock(&page.told).clone();
                    (200, told.unwrap_or_else(|| "null".to_owned()).into_bytes(), "application/json")
                }
                None => text(404, "there is no such page"),
            },
            (Method::Post, ["alive", page]) => match self.opened(page) {
                Some(_) => text(204, ""),
                None => text(429, "too many pages are open; close one of them"),
            },
            (Method::Post, ["bye", page]) => {
                if let Some(page) = lock(&self.pages).remove(*page) {
                    page.cancel(u64::MAX);
                }
                text(204, "")
            }
            (Method::Post, ["cancel", page, number]) => {
                if let (Some(page), Ok(number)) = (self.open(page), number.parse()) {
                    page.cancel(number);
                }
                text(204, "")
            }
            (Method::Post, ["call", page, number]) => match (self.opened(page), number.parse()) {
                (Some(page), Ok(number)) => Self::call(&page, number, request),
                (None, _) => text(429, "too many pages are open; close one of them"),
                _ => text(400, "the call has no number"),
            },
            _ => text(404, "there is nothing here"),
        }
    }

    /// The page, with the names of the files that it begins with.
    fn page(&self) -> String {
        let names =
            self.files.iter().map(|file| file.file_name().unwrap_or(file.as_os_str()).to_string_lossy());
        // Inside a script element only `<` could end the element or begin a comment.
        let served = json!({ "files": names.collect::<Vec<_>>() }).to_string().replace('<', "\\u003c");
        let script = SCRIPTS.join("\n");
        INDEX
            .replace(POLICY_OF_FILE, POLICY)
            .replace("/*STYLE*/", STYLE)
            .replace("/*MODULE*/", "")
            .replace("/*EXAMPLES*/", "{}")
            .replace("/*WORKER*/", "")
            .replace("/*SERVED*/", &served)
            .replace("/*SCRIPT*/", &script)
    }

    fn file(&self, index: &str) -> Said {
        let Some(path) = index.parse().ok().and_then(|index: usize| self.files.get(index)) else {
            return text(404, "there is no such file");
        };
        match std::fs::read(path) {
            Ok(bytes) => (200, bytes, "application/octet-stream"),
            Err(error) => text(500, &format!("{}: {error}", path.display())),
        }
    }

    /// A page that is open.
    fn open(&self, name: &str) -> Option<Arc<Page>> {
        let page = lock(&self.pages).get(name).cloned()?;
        *lock(&page.seen) = Instant::now();
        Some(page)
    }

    /// A page, which is open from now on; `None` where there are too many.
    fn opened(&self, name: &str) -> Option<Arc<Page>> {
        if let Some(page) = self.open(name) {
            return Some(page);
        }
        let mut pages = lock(&self.pages);
        if pages.len() >= MOST_PAGES || name.is_empty() || name.len() > MOST_NAME {
            return None;
        }
        let page = Arc::new(Page {
            engine: Mutex::default(),
            told: Mutex::default(),
            cancelled: Mutex::default(),
            seen: Mutex::new(Instant::now()),
        });
        pages.insert(name.to_owned(), Arc::clone(&page));
        *lock(&self.sent) = None;
        Some(page)
    }

    fn call(page: &Page, number: u64, request: &mut Request) -> Said {
        let mut body = Vec::new();
        if request.as_reader().take(MOST_BODY).read_to_end(&mut body).is_err() {
            return text(400, "the call did not arrive whole");
        }
        let Some(mut arrays) = unframed(&body).filter(|arrays| !arrays.is_empty()) else {
            return text(400, "the call is none: its lengths are not those of its bytes");
        };
        drop(body);
        let call = String::from_utf8_lossy(&arrays.remove(0)).into_owned();
        let mut engine = lock(&page.engine);
        *lock(&page.told) = None;
        let token = CancelToken::default();
        let mut cancelled = lock(&page.cancelled);
        if number <= cancelled.0 {
            token.cancel();
        }
        cancelled.1 = token.clone();
        drop(cancelled);
        let reply = engine.call(&call, arrays, &Watching { page, token });
        drop(engine);
        *lock(&page.seen) = Instant::now();
        let mut arrays = vec![reply.json.into_bytes()];
        arrays.extend(reply.arrays);
        (200, framed(&arrays), "application/octet-stream")
    }
}
