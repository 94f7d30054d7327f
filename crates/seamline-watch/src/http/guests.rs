//! Connections that cannot pile up.
//!
//! A connection is an open file, and the daemon needs its files for meshes. So only so many are open at a
//! time, and each is closed after a while, whatever the other side does or fails to do.

use std::io::{self, ErrorKind};
use std::net::SocketAddr;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, ready};
use std::time::Duration;

use axum::serve::Listener;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::{Sleep, sleep};

/// How many connections there may be, and for how long.
#[derive(Clone, Copy, Debug)]
pub(super) struct House {
    pub places: usize,
    pub stay: Duration,
}

/// Room for a few scrapers and probes. They ask again every some seconds, and connect again when they find
/// their connection closed.
impl Default for House {
    fn default() -> Self {
        Self {
            places: 64,
            stay: Duration::from_secs(60),
        }
    }
}

/// A listener; who finds no place waits until one leaves.
pub(super) struct Guests {
    listener: TcpListener,
    places: Arc<Semaphore>,
    stay: Duration,
}

impl Guests {
    pub(super) fn new(listener: TcpListener, house: House) -> Self {
        Self {
            listener,
            places: Arc::new(Semaphore::new(house.places)),
            stay: house.stay,
        }
    }
}

impl Listener for Guests {
    type Io = Guest;
    type Addr = SocketAddr;

    async fn accept(&mut self) -> (Guest, SocketAddr) {
        let place = self.places.clone().acquire_owned().await;
        let (stream, address) = Listener::accept(&mut self.listener).await;
        let guest = Guest {
            stream,
            leave: Box::pin(sleep(self.stay)),
            _place: place.expect("the semaphore is never closed"),
        };
        (guest, address)
    }

    fn local_addr(&self) -> io::Result<SocketAddr> {
        self.listener.local_addr()
    }
}

/// A connection that fails as timed out where it would have to wait longer than it may stay.
pub(super) struct Guest {
    stream: TcpStream,
    leave: Pin<Box<Sleep>>,
    _place: OwnedSemaphorePermit,
}

impl Guest {
    fn until_it_must_leave<T>(
        &mut self,
        context: &mut Context<'_>,
        progress: Poll<io::Result<T>>,
    ) -> Poll<io::Result<T>> {
        if progress.is_pending() {
            ready!(self.leave.as_mut().poll(context));
            return Poll::Ready(Err(ErrorKind::TimedOut.into()));
        }
        progress
    }
}

impl AsyncRead for Guest {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let progress = Pin::new(&mut self.stream).poll_read(context, buffer);
        self.until_it_must_leave(context, progress)
    }
}

impl AsyncWrite for Guest {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let progress = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.until_it_must_leave(context, progress)
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}
