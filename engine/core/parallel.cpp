#include "engine/core/parallel.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "engine/core/stopwatch.h"

namespace weft {
namespace {

int processors() {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
    return std::max(1u, std::thread::hardware_concurrency());
}

thread_local bool inside_parallel = false;

// One parallel_for call. Helpers and the caller take indices from `next` until none is left.
//
// Much work is over before a thread is awake, and to wake a machine's worth of threads for it takes
// longer than doing it. So the caller wakes two, and whoever takes an index two more for as long as
// what is left is worth it.
class Work {
  public:
    Work(const std::function<void(std::size_t)>& body, std::size_t n) : body_(&body), n_(n) {}

    [[nodiscard]] std::size_t left() const {
        return n_ - std::min(n_, next_.load(std::memory_order_relaxed));
    }

    /// Wakes two helpers, if there is something for them.
    void wake(std::condition_variable& helpers) {
        for (int k = 0; k < 2 && woken_.fetch_add(1, std::memory_order_relaxed) + 1 < n_; ++k)
            helpers.notify_one();
    }

    /// Takes indices until none is left. `helps`: not the caller, who has just woken two.
    void run(std::condition_variable& helpers, bool helps) {
        const bool nested = std::exchange(inside_parallel, true);
        for (std::size_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < n_;) {
            if (helps && woken_.load(std::memory_order_relaxed) + 1 < n_ && lasts()) wake(helpers);
            helps = true;
            try {
                (*body_)(i);
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (!error_) error_ = std::current_exception();
            }
            if (finished_.fetch_add(1) + 1 == n_) {
                const std::lock_guard lock(mutex_);
                all_done_.notify_all();
            }
        }
        inside_parallel = nested;
    }

    /// Until every index is done. Rethrows what one of them threw.
    void wait() {
        std::unique_lock lock(mutex_);
        all_done_.wait(lock, [&] { return finished_.load() == n_; });
        if (error_) std::rethrow_exception(error_);
    }

  private:
    // Whether what is left, at the pace so far, takes longer than a thread takes to wake. Where
    // nothing is finished yet when a helper comes, a single index does.
    [[nodiscard]] bool lasts() const {
        constexpr double kWaking_s = 50e-6;
        const auto finished = static_cast<double>(finished_.load(std::memory_order_relaxed));
        return seconds_since(start_) * static_cast<double>(left()) > kWaking_s * finished;
    }

    const std::function<void(std::size_t)>* body_;
    const std::size_t n_;
    const Clock::time_point start_ = Clock::now();
    std::atomic<std::size_t> next_{0}, finished_{0}, woken_{0};
    std::mutex mutex_;
    std::condition_variable all_done_;
    std::exception_ptr error_;
};

// Helper threads that live until the process ends. Several callers may hand in work at once: each
// helper joins the oldest work that still has indices.
class Pool {
  public:
    static Pool& instance() {
        static Pool pool;
        return pool;
    }

    ~Pool() {
        {
            const std::lock_guard lock(mutex_);
            stop_ = true;
        }
        wake_.notify_all();
        surplus_.notify_all();
        for (auto& t : helpers_)
            t.join();
    }

    void set_count(int count) {
        const std::lock_guard lock(mutex_);
        count_ = count > 0 ? count : processors();
        note_usable();
        wake_.notify_all();
        surplus_.notify_all();
    }

    int count() {
        const std::lock_guard lock(mutex_);
        return count_;
    }

    /// Whether a helper has nothing to do. A hint: the next moment it may.
    [[nodiscard]] bool has_idle_helper() const {
        return busy_.load(std::memory_order_relaxed) < usable_.load(std::memory_order_relaxed);
    }

    void run(const std::shared_ptr<Work>& work) {
        {
            const std::lock_guard lock(mutex_);
            while (static_cast<int>(helpers_.size()) < count_ - 1) {
                const int index = static_cast<int>(helpers_.size());
                helpers_.emplace_back([this, index] { loop(index); });
                note_usable();
            }
            std::erase_if(queue_, [](const auto& w) { return w->left() == 0; });
            queue_.push_back(work);
        }
        work->wake(wake_);
        work->run(wake_, false);
        work->wait();
    }

  private:
    void loop(int index) {
        std::unique_lock lock(mutex_);
        while (!stop_) {
            if (index >= count_ - 1) {
                surplus_.wait(lock);
                continue;
            }
            const std::shared_ptr<Work> work = claim();
            if (!work) {
                wake_.wait(lock);
                continue;
            }
            ++busy_;
            lock.unlock();
            work->run(wake_, true);
            lock.lock();
            --busy_;
        }
    }

    std::shared_ptr<Work> claim() {
        for (const auto& work : queue_) {
            if (work->left() > 0) return work;
        }
        return nullptr;
    }

    void note_usable() { usable_ = std::min(static_cast<int>(helpers_.size()), count_ - 1); }

    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable surplus_;       // where helpers beyond the current count sleep
    std::atomic<int> busy_{0}, usable_{0};  // helpers that run work; that may
    std::vector<std::thread> helpers_;
    std::vector<std::shared_ptr<Work>> queue_;  // and some of which no index is left
    int count_ = processors();
    bool stop_ = false;
};

}  // namespace

void set_thread_count(int count) {
    Pool::instance().set_count(count);
}
int thread_count() {
    return Pool::instance().count();
}

void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) {
    if (n == 0) return;
    // Inside a body all threads have work of their own, until the last bodies run.
    if (n == 1 || thread_count() == 1 || (inside_parallel && !Pool::instance().has_idle_helper())) {
        for (std::size_t i = 0; i < n; ++i)
            body(i);
        return;
    }
    Pool::instance().run(std::make_shared<Work>(body, n));
}

Status parallel_try(std::size_t n, const std::function<Status(std::size_t)>& body) {
    std::vector<Status> done(n);
    parallel_for(n, [&](std::size_t i) { done[i] = body(i); });
    for (Status& status : done)
        WEFT_CHECK_OK(std::move(status));
    return {};
}

void parallel_rows(int height, int band, const std::function<void(int, int)>& body) {
    const int bands = (height + band - 1) / band;
    parallel_for(static_cast<std::size_t>(bands), [&](std::size_t i) {
        const int y0 = static_cast<int>(i) * band;
        body(y0, std::min(height, y0 + band));
    });
}

}  // namespace weft
