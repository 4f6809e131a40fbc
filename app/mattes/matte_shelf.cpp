#include "app/mattes/matte_shelf.h"

#include <algorithm>
#include <filesystem>

#include "app/base/background.h"
#include "engine/media/frame_writer.h"

namespace weft {
namespace {

Status write_with_folder(const std::string& path, const Matte& matte) {
    WEFT_CHECK_OK(make_folder_of(path, WriteRule::own()));
    return write_matte(path, matte, WriteRule::own());
}

}  // namespace

MatteShelf::MatteShelf(std::size_t budget_bytes)
    : budget_bytes_(budget_bytes), thread_([this] { work(); }) {}

MatteShelf::~MatteShelf() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
        std::erase_if(tasks_, [](const Task& task) { return !task.matte; });
    }
    wake_.notify_all();
    thread_.join();
}

MattePtr MatteShelf::get(const std::string& name, const Reader& read) {
    const std::lock_guard lock(mutex_);
    if (const auto found = kept_.find(name); found != kept_.end()) {
        found->second.used = ++clock_;
        return found->second.matte;
    }
    if (const auto found = unwritten_.find(name); found != unwritten_.end()) return found->second;
    if (errors_.contains(name) || !read || reading_ == name) return nullptr;
    const auto waiting = std::find_if(tasks_.begin(), tasks_.end(),
                                      [&](const Task& task) { return task.name == name; });
    if (waiting != tasks_.end()) return nullptr;
    constexpr std::size_t kMostWaiting = 64;
    if (tasks_.size() > kMostWaiting) {
        const auto oldest = std::find_if(tasks_.begin(), tasks_.end(),
                                         [](const Task& task) { return !task.matte; });
        if (oldest != tasks_.end()) tasks_.erase(oldest);
    }
    tasks_.push_back({name, read, nullptr});
    wake_.notify_one();
    return nullptr;
}

std::string MatteShelf::error(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    const auto found = errors_.find(name);
    return found == errors_.end() ? std::string() : found->second;
}

void MatteShelf::forget(const std::string& name) {
    const std::lock_guard lock(mutex_);
    errors_.erase(name);
    const auto found = kept_.find(name);
    if (found == kept_.end()) return;
    bytes_ -= found->second.matte->size_bytes();
    kept_.erase(found);
}

void MatteShelf::write(const std::string& path, MattePtr matte) {
    std::vector<MattePtr> gone;  // destroyed after the lock is released
    {
        const std::lock_guard lock(mutex_);
        bytes_ += matte->size_bytes();
        if (const auto old = kept_.find(path); old != kept_.end())
            bytes_ -= old->second.matte->size_bytes();
        kept_[path] = {matte, ++clock_};
        errors_.erase(path);
        unwritten_[path] = matte;
        tasks_.push_front({path, {}, std::move(matte)});
        ++to_write_;
        ++changes_;
        gone = trim();
    }
    wake_.notify_one();
}

std::string MatteShelf::take_write_error() {
    const std::lock_guard lock(mutex_);
    return std::exchange(write_error_, {});
}

bool MatteShelf::writing() const {
    const std::lock_guard lock(mutex_);
    return to_write_ > 0;
}

std::map<std::string, MattePtr> MatteShelf::unwritten() const {
    const std::lock_guard lock(mutex_);
    return unwritten_;
}

void MatteShelf::flush() {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] {
        return running_ == 0 && std::none_of(tasks_.begin(), tasks_.end(), [](const Task& task) {
                   return task.matte != nullptr;
               });
    });
}

std::uint64_t MatteShelf::changes() const {
    return changes_.load();
}

std::vector<MattePtr> MatteShelf::trim() {
    std::vector<MattePtr> gone;
    while (bytes_ > budget_bytes_ && kept_.size() > 1) {
        const auto oldest = std::min_element(
            kept_.begin(), kept_.end(),
            [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
        bytes_ -= oldest->second.matte->size_bytes();
        gone.push_back(std::move(oldest->second.matte));
        kept_.erase(oldest);
    }
    return gone;
}

void MatteShelf::work() {
    lower_thread_priority();
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return stop_ || !tasks_.empty(); });
        if (tasks_.empty()) return;
        // Write painted mattes in their order first, then read the newest request.
        auto next = std::find_if(tasks_.rbegin(), tasks_.rend(),
                                 [](const Task& task) { return task.matte != nullptr; });
        if (next == tasks_.rend()) next = tasks_.rbegin();
        const Task task = *next;
        tasks_.erase(std::next(next).base());
        ++running_;
        if (!task.matte) reading_ = task.name;
        lock.unlock();
        Status written;
        Expected<Matte> read{Matte{}};
        if (task.matte) {
            written = write_with_folder(task.name, *task.matte);
        } else {
            read = task.read();
        }
        lock.lock();
        reading_.clear();
        --running_;
        ++changes_;
        if (task.matte) {
            --to_write_;
            if (written)
                unwritten_.erase(task.name);
            else
                write_error_ = written.error().text();
        } else if (read) {
            auto matte = std::make_shared<const Matte>(std::move(*read));
            bytes_ += matte->size_bytes();
            kept_[task.name] = {std::move(matte), ++clock_};
            std::vector<MattePtr> gone = trim();
            if (!gone.empty()) {
                lock.unlock();
                gone.clear();
                lock.lock();
            }
        } else {
            errors_[task.name] = read.error().text();
        }
        done_.notify_all();
    }
}

}  // namespace weft
