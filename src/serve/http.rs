//! The server: HTTP/1.1 by `hyper` on one thread, answers computed on others, with limits on size and time.
//!
//! Slow or silent clients hold a connection until its time is over and no computing thread. A request whose client has gone before its
//! turn comes is not computed.

use std::convert::Infallible;
use std::net::TcpListener;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use http_body_util::{BodyExt, Full, Limited};
use hyper::body::{Bytes, Incoming};
use hyper::header::{CONTENT_TYPE, HeaderValue};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{Request, Response, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::sync::oneshot;
use tokio::task::JoinSet;
use tokio::time::timeout;

use super::protocol::Answer;

/// What a server lets its clients do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Largest body, bytes.
    pub body: usize,
    /// How long the head of a request, and then its body, may take to arrive.
    pub arrival: Duration,
    /// Connections at once; further ones wait for one of them to end.
    pub connections: usize,
    /// Requests that wait for a computing thread; further ones are told to come again.
    pub waiting: usize,
    /// Answers computed at once.
    pub computing: usize,
    /// How long requests that have come may still take when the server ends.
    pub end: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            body: 1 << 20,
            arrival: Duration::from_secs(30),
            connections: 512,
            waiting: 1024,
            computing: 1,
            end: Duration::from_secs(10),
        }
    }
}

/// A request on its way to a computing thread.
struct Job {
    method: String,
    path: String,
    body: Bytes,
    reply: oneshot::Sender<Answer>,
}

/// Serves until the system asks the program to end (SIGTERM, Ctrl-C): no connection is taken any more then, requests that have come are
/// answered, for as long as [`Limits::end`].
///
/// `compute` makes the answer from method, path and body.
///
/// # Errors
/// An error of the system if the listener cannot be used.
pub fn serve(
    listener: TcpListener,
    limits: Limits,
    compute: &(dyn Fn(&str, &str, &[u8]) -> Answer + Sync),
) -> std::io::Result<()> {
    listener.set_nonblocking(true)?;
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    let (jobs, queue) = sync_channel::<Job>(limits.waiting);
    let queue = Mutex::new(queue);
    std::thread::scope(|scope| {
        for _ in 0..limits.computing.max(1) {
            scope.spawn(|| work(&queue, compute));
        }
        // ends the queue, and with it the threads
        let outcome = runtime.block_on(listen(listener, limits, jobs));
        runtime.shutdown_background();
        outcome
    })
}

/// Computes one answer after the other until there are no more requests to come.
fn work(queue: &Mutex<Receiver<Job>>, compute: &(dyn Fn(&str, &str, &[u8]) -> Answer + Sync)) {
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).recv();
    while let Ok(job) = next() {
        if job.reply.is_closed() {
            continue;
        }
        let found = catch_unwind(AssertUnwindSafe(|| {
            compute(&job.method, &job.path, &job.body)
        }));
        let answer = found.unwrap_or_else(|_| {
            Answer::error(
                500,
                "InvalidOutput",
                "the model failed; the server's log says where",
            )
        });
        // the client may have gone meanwhile
        let _ = job.reply.send(answer);
    }
}

async fn listen(
    listener: TcpListener,
    limits: Limits,
    jobs: SyncSender<Job>,
) -> std::io::Result<()> {
    let listener = tokio::net::TcpListener::from_std(listener)?;
    let (ending, ended) = tokio::sync::watch::channel(false);
    let mut connections = JoinSet::new();
    let mut stop = std::pin::pin!(asked_to_end());
    loop {
        while connections.try_join_next().is_some() {}
        if connections.len() >= limits.connections {
            tokio::select! {
                _ = connections.join_next() => continue,
                () = &mut stop => break,
            }
        }
        let accepted = tokio::select! {
            accepted = listener.accept() => accepted,
            () = &mut stop => break,
        };
        let Ok((stream, _)) = accepted else {
            // out of file handles, or gone before it came: others may do better
            tokio::time::sleep(Duration::from_millis(20)).await;
            continue;
        };
        // answers are small and wanted at once
        let _ = stream.set_nodelay(true);
        let (jobs, mut ended) = (jobs.clone(), ended.clone());
        connections.spawn(async move {
            let service = service_fn(move |request| {
                let jobs = jobs.clone();
                async move { Ok::<_, Infallible>(respond(request, limits, &jobs).await) }
            });
            let mut http = http1::Builder::new();
            http.timer(TokioTimer::new())
                .header_read_timeout(limits.arrival);
            let connection = http.serve_connection(TokioIo::new(stream), service);
            let mut connection = std::pin::pin!(connection);
            // a client's mistakes and its going are no concern of others
            tokio::select! {
                _ = connection.as_mut() => return,
                _ = ended.changed() => connection.as_mut().graceful_shutdown(),
            }
            let _ = connection.await;
        });
    }
    drop(listener);
    drop(jobs);
    let _ = ending.send(true);
    let all = async { while connections.join_next().await.is_some() {} };
    let _ = timeout(limits.end, all).await;
    connections.shutdown().await;
    Ok(())
}

/// Reads the body within its limits and waits for the answer.
async fn respond(
    request: Request<Incoming>,
    limits: Limits,
    jobs: &SyncSender<Job>,
) -> Response<Full<Bytes>> {
    let (head, body) = request.into_parts();
    let refused = |status, message: &str| Answer::error(status, "InvalidInput", message);
    let body = match timeout(limits.arrival, Limited::new(body, limits.body).collect()).await {
        Err(_) => return response(refused(408, "the body took too long to arrive")),
        Ok(Err(_)) => {
            let message = format!(
                "the body cannot be read, or is larger than {} bytes",
                limits.body
            );
            return response(refused(413, &message));
        }
        Ok(Ok(body)) => body.to_bytes(),
    };
    let (reply, answer) = oneshot::channel();
    let job = Job {
        method: head.method.as_str().to_owned(),
        path: head.uri.path().to_owned(),
        body,
        reply,
    };
    if let Err(error) = jobs.try_send(job) {
        let message = match error {
            TrySendError::Full(_) => "too many requests are waiting; ask again later",
            TrySendError::Disconnected(_) => "the server is ending",
        };
        return response(refused(503, message));
    }
    let ending = || refused(503, "the server is ending");
    response(answer.await.unwrap_or_else(|_| ending()))
}

fn response(answer: Answer) -> Response<Full<Bytes>> {
    let mut response = Response::new(Full::new(Bytes::from(answer.body)));
    *response.status_mut() =
        StatusCode::from_u16(answer.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
    let json = HeaderValue::from_static("application/json");
    response.headers_mut().insert(CONTENT_TYPE, json);
    response
}

/// Ends when the system asks the program to.
async fn asked_to_end() {
    #[cfg(unix)]
    {
        use tokio::signal::unix::{SignalKind, signal};
        if let Ok(mut terminate) = signal(SignalKind::terminate()) {
            tokio::select! {
                _ = terminate.recv() => {}
                _ = interrupted() => {}
            }
            return;
        }
    }
    let _ = interrupted().await;
}

async fn interrupted() {
    // without a handler the system ends the program itself
    if tokio::signal::ctrl_c().await.is_err() {
        std::future::pending::<()>().await;
    }
}
