//! Health, readiness and metrics over HTTP, for whoever watches over the daemon.

mod guests;
#[cfg(test)]
mod tests;

use std::io;
use std::net::{SocketAddr, TcpListener};
use std::sync::Arc;
use std::thread::{Builder, JoinHandle};
use std::time::{Duration, Instant};

use axum::Router;
use axum::extract::State;
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::IntoResponse;
use axum::routing::get;
use tokio::runtime;
use tokio::sync::watch;
use tokio::time::timeout;

use crate::health::Health;
use crate::metrics::{self, Metrics};
use guests::{Guests, House};

/// How long requests that are under way may take to end when the server stops.
const GRACE: Duration = Duration::from_secs(1);

const INDEX: &str = "Seamline watches a folder.\n\
    /health   200 while the daemon is alive\n\
    /ready    200 while it can do its work, else 503 with the reasons\n\
    /metrics  counts and times in OpenMetrics text\n";

/// Why health and metrics cannot be served.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// The address is taken, or not one of this machine, or not allowed.
    #[error("cannot listen on {address}: {error}")]
    Listen {
        /// The address that was asked for.
        address: SocketAddr,
        /// What the system says.
        error: io::Error,
    },
    /// The system gives no more threads or files.
    #[error("the HTTP server cannot be started: {0}")]
    Start(io::Error),
}

impl ServeError {
    /// What to do about it: one sentence.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Listen { .. } => {
                "set `http.listen` to an address of this machine with a free port, or to \"\" for none"
            }
            Self::Start(_) => {
                "raise the limits of threads and open files, or set `http.listen` to \"\""
            }
        }
    }
}

/// A server that serves until this is dropped.
#[derive(Debug)]
pub struct Serving {
    address: SocketAddr,
    stop: Option<watch::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Serving {
    /// Where it listens; the port is a real one even if 0 was asked for.
    pub fn address(&self) -> SocketAddr {
        self.address
    }
}

/// Takes no more requests, gives those under way a second to end, and then closes every connection.
impl Drop for Serving {
    fn drop(&mut self) {
        self.stop = None;
        if let Some(thread) = self.thread.take() {
            // It panicked; there is nothing left to stop.
            let _ = thread.join();
        }
    }
}

/// Serves `/health`, `/ready` and `/metrics` from a thread of its own. Whoever connects now is answered, even if
/// that thread has not begun. Port 0 picks a free one.
///
/// # Errors
///
/// [`ServeError`]; nothing is served then.
pub fn serve(
    listen: SocketAddr,
    health: Arc<Health>,
    metrics: Arc<Metrics>,
) -> Result<Serving, ServeError> {
    serve_in(House::default(), listen, Shared { health, metrics })
}

fn serve_in(house: House, listen: SocketAddr, shared: Shared) -> Result<Serving, ServeError> {
    let refused = |error| ServeError::Listen {
        address: listen,
        error,
    };
    let listener = TcpListener::bind(listen).map_err(refused)?;
    let address = listener.local_addr().map_err(refused)?;
    listener.set_nonblocking(true).map_err(refused)?;

    let runtime = runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .map_err(ServeError::Start)?;
    let guests = {
        let _inside = runtime.enter();
        let listener = tokio::net::TcpListener::from_std(listener).map_err(ServeError::Start)?;
        Guests::new(listener, house)
    };
    let (stop, stopped) = watch::channel(());
    let thread = Builder::new()
        .name("http".to_owned())
        .spawn(move || runtime.block_on(run(guests, router(shared), stopped)))
        .map_err(ServeError::Start)?;
    Ok(Serving {
        address,
        stop: Some(stop),
        thread: Some(thread),
    })
}

async fn run(guests: Guests, router: Router, stopped: watch::Receiver<()>) {
    let server =
        axum::serve(guests, router).with_graceful_shutdown(sender_is_gone(stopped.clone()));
    let server = tokio::spawn(server.into_future());
    sender_is_gone(stopped).await;
    // Who has not ended by then is cut off when the runtime is dropped.
    let _ = timeout(GRACE, server).await;
}

async fn sender_is_gone(mut stopped: watch::Receiver<()>) {
    while stopped.changed().await.is_ok() {}
}

#[derive(Clone)]
struct Shared {
    health: Arc<Health>,
    metrics: Arc<Metrics>,
}

fn router(shared: Shared) -> Router {
    Router::new()
        .route("/", get(async || INDEX))
        .route("/health", get(health))
        .route("/ready", get(ready))
        .route("/metrics", get(all_metrics))
        .fallback(async || {
            (
                StatusCode::NOT_FOUND,
                "not here; there are /health, /ready and /metrics\n",
            )
        })
        .method_not_allowed_fallback(async || {
            (StatusCode::METHOD_NOT_ALLOWED, "only GET is answered\n")
        })
        .with_state(shared)
}

async fn health(State(shared): State<Shared>) -> impl IntoResponse {
    let now = Instant::now();
    if shared.health.is_alive(now) {
        (StatusCode::OK, "ok\n".to_owned())
    } else {
        let silence = shared.health.silence(now).as_secs();
        (
            StatusCode::SERVICE_UNAVAILABLE,
            format!("no sign of life for {silence} s\n"),
        )
    }
}

async fn ready(State(shared): State<Shared>) -> impl IntoResponse {
    let troubles = shared.health.troubles(Instant::now());
    if troubles.is_empty() {
        (StatusCode::OK, "ready\n".to_owned())
    } else {
        (StatusCode::SERVICE_UNAVAILABLE, troubles.join("\n") + "\n")
    }
}

async fn all_metrics(State(shared): State<Shared>) -> impl IntoResponse {
    (
        [(CONTENT_TYPE, metrics::CONTENT_TYPE)],
        shared.metrics.encode(),
    )
}
