#pragma once
// One question at a time for a background thread: the newest wins, and the asker never waits.
//
// No lock is shared with the worker. A worker of low priority may be interrupted at any point, for
// as long as a busy machine likes; a lock that it holds then would stop the window.

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

/// Room for one value that some threads leave and others take. Thread-safe and wait-free.
template <class T>
class Mailbox {
  public:
    Mailbox() = default;
    ~Mailbox() { delete slot_.load(); }
    Mailbox(const Mailbox&) = delete;
    Mailbox& operator=(const Mailbox&) = delete;

    /// Replaces, and frees, a value that nobody has taken.
    void put(std::unique_ptr<T> value) { delete slot_.exchange(value.release()); }
    /// Null: there is none.
    [[nodiscard]] std::unique_ptr<T> take() { return std::unique_ptr<T>(slot_.exchange(nullptr)); }

  private:
    std::atomic<T*> slot_{nullptr};
};

/// The newest value of something that workers make and the window shows. Thread-safe. put() is
/// wait-free; get() waits for no put(), only for another get(): call it from threads of one
/// priority.
template <class T>
class Published {
  public:
    using Ptr = std::shared_ptr<const T>;

    /// get() gives null until the first put().
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

/// Of a worker's thread: kBackground gives way to the window, kWindow is for work of a few
/// milliseconds that the window's next frame shows.
enum class WorkerPriority : std::uint8_t { kBackground, kWindow };

/// A thread that runs the newest job it was given; one that has not begun when another comes is
/// dropped.
class LatestThread {
  public:
    using Job = std::function<void()>;

    explicit LatestThread(WorkerPriority priority);
    /// Waits for the job that has begun. One that has not is dropped.
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

/// Answers questions of one kind in a thread of its own. A question is named by its key, which
/// stands for all that the answer depends on. At most one question is worked on and one waits; a
/// newer one replaces the waiting one and cancels the other. Asking the same again, in every frame
/// that is drawn, does nothing while the question waits, is worked on, or is answered.
///
/// Thread-safe: ask(), try_read() and newest() never wait for the worker, only for each other; call
/// them from threads of one priority. Callers that ask different things in turn keep each other
/// from an answer: give each a worker of its own.
template <class Key, class Result>
class LatestWorker {
  public:
    using ResultPtr = std::shared_ptr<const Result>;
    /// Runs in the worker's thread. May return nothing once the token is cancelled, which nobody
    /// waits for any more; where it is not cancelled, the question may be asked again.
    using Work = std::function<std::optional<Result>(const CancelToken&)>;

    /// `arrived` is called in the worker's thread after each answer; it must be thread-safe.
    explicit LatestWorker(std::function<void()> arrived = {},
                          WorkerPriority priority = WorkerPriority::kBackground)
        : arrived_(std::move(arrived)), thread_(priority) {}
    ~LatestWorker() { token_.cancel(); }
    LatestWorker(const LatestWorker&) = delete;
    LatestWorker& operator=(const LatestWorker&) = delete;

    /// The answer, or null and then the question is asked, unless it has been.
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

    /// The answer to this question; null: it is not there, or a newer question has replaced it.
    [[nodiscard]] ResultPtr try_read(const Key& key) const {
        const std::lock_guard lock(askers_);
        take_answer();
        return last_.key == key ? last_.result : nullptr;
    }

    /// The latest answer, whatever was asked; null before the first.
    [[nodiscard]] ResultPtr newest() const {
        const std::lock_guard lock(askers_);
        take_answer();
        return last_.result;
    }

    /// Whether the newest question is not answered yet.
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
            asked_.reset();  // it gave up
    }

    const std::function<void()> arrived_;
    mutable std::mutex askers_;
    mutable std::optional<Key> asked_;  // waiting, worked on, or answered
    std::uint64_t serial_ = 0;
    CancelToken token_;  // of asked_
    mutable Answer last_;
    mutable Mailbox<Answer> answers_;
    LatestThread thread_;  // ends first
};

}  // namespace weft
