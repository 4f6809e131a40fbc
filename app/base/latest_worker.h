#pragma once
// Runs one request at a time in a background thread. The newest request wins, and the caller never
// waits.
//
// The caller and the worker share no lock: a low-priority worker may be preempted for a long time
// on a busy machine, and a lock held by it would block the window.

#include <semaphore.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "engine/core/cancel.h"

namespace weft {

/// A slot for one value that some threads put and others take. Thread-safe and wait-free.
template <class T>
class Mailbox {
  public:
    Mailbox() = default;
    ~Mailbox() { delete slot_.load(); }
    Mailbox(const Mailbox&) = delete;
    Mailbox& operator=(const Mailbox&) = delete;

    /// Replaces and frees a value that was not taken.
    void put(std::unique_ptr<T> value) { delete slot_.exchange(value.release()); }
    /// Returns null if the slot is empty.
    [[nodiscard]] std::unique_ptr<T> take() { return std::unique_ptr<T>(slot_.exchange(nullptr)); }

  private:
    std::atomic<T*> slot_{nullptr};
};

/// The newest of a series of values that workers produce and the window shows. Thread-safe. put()
/// is wait-free; get() waits only for another get(), so call it from threads of one priority.
template <class T>
class Published {
  public:
    using Ptr = std::shared_ptr<const T>;

    /// get() returns null until the first put().
    Published() = default;
    explicit Published(T first) : seen_(std::make_shared<const T>(std::move(first))) {}

    void put(T value) { put(std::make_shared<const T>(std::move(value))); }
    void put(Ptr value) { fresh_.put(std::make_unique<Ptr>(std::move(value))); }

    [[nodiscard]] Ptr get() const {
        const std::lock_guard lock(readers_);
        if (const auto fresh = fresh_.take()) seen_ = std::move(*fresh);
        return seen_;
    }

  private:
    mutable Mailbox<Ptr> fresh_;
    mutable std::mutex readers_;
    mutable Ptr seen_;
};

/// Priority of a worker's thread. kBackground yields to the window; kWindow is for work of a few
/// milliseconds whose result the next frame of the window shows.
enum class WorkerPriority : std::uint8_t { kBackground, kWindow };

/// A thread that runs the newest posted job. A job that has not started when another is posted is
/// dropped.
class LatestThread {
  public:
    using Job = std::function<void()>;

    explicit LatestThread(WorkerPriority priority);
    /// Waits for the running job. A job that has not started is dropped.
    ~LatestThread();
    LatestThread(const LatestThread&) = delete;
    LatestThread& operator=(const LatestThread&) = delete;

    /// Wait-free.
    void post(Job job);

  private:
    void run(WorkerPriority priority);

    Mailbox<Job> next_;
    std::atomic<bool> stop_{false};
    sem_t posted_;
    std::thread thread_;
};

/// Answers requests of one kind in its own thread. A request is identified by its key, which covers
/// everything that the answer depends on. At most one request runs and one waits: a newer one
/// replaces the waiting one and cancels the running one. Repeating a request (for example in every
/// drawn frame) does nothing while it waits, runs or is answered.
///
/// Thread-safe: ask(), try_read() and newest() never wait for the worker, only for each other; call
/// them from threads of one priority. Callers that alternate between different requests would
/// cancel each other: give each its own worker.
template <class Key, class Result>
class LatestWorker {
  public:
    using ResultPtr = std::shared_ptr<const Result>;
    /// Runs in the worker's thread. It may return nothing once the token is cancelled. If it
    /// returns nothing without cancellation, the request may be repeated.
    using Work = std::function<std::optional<Result>(const CancelToken&)>;

    /// `arrived` is called in the worker's thread after each answer. It must be thread-safe.
    explicit LatestWorker(std::function<void()> arrived = {},
                          WorkerPriority priority = WorkerPriority::kBackground)
        : arrived_(std::move(arrived)), thread_(priority) {}
    ~LatestWorker() { token_.cancel(); }
    LatestWorker(const LatestWorker&) = delete;
    LatestWorker& operator=(const LatestWorker&) = delete;

    /// Returns the answer, or null and starts the request unless it is already pending.
    ResultPtr ask(const Key& key, Work work) {
        const std::lock_guard lock(askers_);
        take_answer();
        if (asked_ == key) return last_.key == key ? last_.result : nullptr;
        token_.cancel();
        token_ = CancelToken();
        asked_ = key;
        thread_.post([this, key, serial = ++serial_, token = token_, work = std::move(work)] {
            auto answer = std::make_unique<Answer>(Answer{serial, key, nullptr});
            if (std::optional<Result> result = work(token))
                answer->result = std::make_shared<const Result>(std::move(*result));
            answers_.put(std::move(answer));
            if (arrived_) arrived_();
        });
        return last_.key == key ? last_.result : nullptr;
    }

    /// The answer to this request; null: not available yet, or replaced by a newer request.
    [[nodiscard]] ResultPtr try_read(const Key& key) const {
        const std::lock_guard lock(askers_);
        take_answer();
        return last_.key == key ? last_.result : nullptr;
    }

    /// The latest answer to any request; null before the first.
    [[nodiscard]] ResultPtr newest() const {
        const std::lock_guard lock(askers_);
        take_answer();
        return last_.result;
    }

    /// Returns true while the newest request has no answer.
    [[nodiscard]] bool busy() const {
        const std::lock_guard lock(askers_);
        take_answer();
        return asked_ && last_.serial != serial_;
    }

  private:
    struct Answer {
        std::uint64_t serial = 0;
        std::optional<Key> key;
        ResultPtr result;
    };
    void take_answer() const {
        const auto fresh = answers_.take();
        if (!fresh) return;
        if (fresh->result)
            last_ = std::move(*fresh);
        else if (fresh->serial == serial_)
            asked_.reset();  // The work returned no answer.
    }

    const std::function<void()> arrived_;
    mutable std::mutex askers_;
    mutable std::optional<Key> asked_;  // waiting, running or answered
    std::uint64_t serial_ = 0;
    CancelToken token_;  // of asked_
    mutable Answer last_;
    mutable Mailbox<Answer> answers_;
    LatestThread thread_;  // destroyed first
};

}  // namespace weft
