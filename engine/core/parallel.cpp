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

namespace weft {
namespace {

int processors() {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
    return std::max(1u, std::thread::hardware_concurrency());
}

thread_local bool inside_parallel = false;

// One parallel_for call. Helpers and the caller take indices from `next` until none is left.
struct Work {
    const std::function<void(std::size_t)>* body;
    std::size_t n;
    std::atomic<std::size_t> next{0};
    std::atomic<std::size_t> finished{0};
    std::mutex mutex;
    std::condition_variable all_done;
    std::exception_ptr error;

    void run() {
        const bool nested = std::exchange(inside_parallel, true);
        std::size_t done = 0;
        for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < n; ++done) {
            try {
                (*body)(i);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!error) error = std::current_exception();
            }
        }
        inside_parallel = nested;
        if (done > 0 && finished.fetch_add(done) + done == n) {
            const std::lock_guard lock(mutex);
            all_done.notify_all();
        }
    }
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
        for (auto& t : helpers_)
            t.join();
    }

    void set_count(int count) {
        const std::lock_guard lock(mutex_);
        count_ = count > 0 ? count : processors();
        note_usable();
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
            queue_.push_back(work);
        }
        wake_.notify_all();
        work->run();
        {
            std::unique_lock lock(work->mutex);
            work->all_done.wait(lock, [&] { return work->finished.load() == work->n; });
        }
        const std::lock_guard lock(mutex_);
        std::erase(queue_, work);
    }

  private:
    void loop(int index) {
        std::unique_lock lock(mutex_);
        while (true) {
            std::shared_ptr<Work> work;
            wake_.wait(lock, [&] { return stop_ || (work = claim(index)) != nullptr; });
            if (stop_) return;
            ++busy_;
            lock.unlock();
            work->run();
            lock.lock();
            --busy_;
        }
    }

    // Helpers beyond the current count sleep.
    std::shared_ptr<Work> claim(int index) {
        if (index >= count_ - 1) return nullptr;
        for (const auto& work : queue_) {
            if (work->next.load(std::memory_order_relaxed) < work->n) return work;
        }
        return nullptr;
    }

    void note_usable() { usable_ = std::min(static_cast<int>(helpers_.size()), count_ - 1); }

    std::mutex mutex_;
    std::condition_variable wake_;
    std::atomic<int> busy_{0}, usable_{0};  // helpers that run work; that may
    std::vector<std::thread> helpers_;
    std::vector<std::shared_ptr<Work>> queue_;
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
    const auto work = std::make_shared<Work>();
    work->body = &body;
    work->n = n;
    Pool::instance().run(work);
    if (work->error) std::rethrow_exception(work->error);
}

void parallel_rows(int height, int band, const std::function<void(int, int)>& body) {
    const int bands = (height + band - 1) / band;
    parallel_for(static_cast<std::size_t>(bands), [&](std::size_t i) {
        const int y0 = static_cast<int>(i) * band;
        body(y0, std::min(height, y0 + band));
    });
}

}  // namespace weft
