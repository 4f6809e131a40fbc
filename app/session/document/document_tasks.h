#pragma once
#include <utility>

#include "app/base/background_tasks.h"
#include "app/session/document/document.h"

namespace weft {

/// Background work on files, each piece of which ends with a function on the window's thread. For
/// one thread.
class DocumentTasks {
  public:
    using Finish = BackgroundTasks::Finish;

    /// The document must stay.
    explicit DocumentTasks(const Document& document) : document_(document) {}

    /// Starts `work`, which returns a Finish.
    template <class Work>
    void start(Work&& work) {
        tasks_.start(std::forward<Work>(work));
    }
    /// The same for work that ends in the document in which it began; its end is dropped if another
    /// document has been opened meanwhile.
    template <class Work>
    void start_for_document(Work&& work) {
        start([&document = document_, id = document_.id(),
               work = std::forward<Work>(work)]() mutable -> Finish {
            return [&document, id, finish = work()] {
                if (id == document.id() && finish) finish();
            };
        });
    }
    /// As BackgroundTasks::finish().
    void finish(bool wait) { tasks_.finish(wait); }
    [[nodiscard]] bool empty() const { return tasks_.empty(); }
    /// Waits for the work in progress and drops its ends.
    void drop() { tasks_ = {}; }

  private:
    const Document& document_;
    BackgroundTasks tasks_;
};

}  // namespace weft
