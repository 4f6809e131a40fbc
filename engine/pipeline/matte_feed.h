#pragma once
// Hands the mattes that one thread makes to those that follow the surfaces, while both work.

#include <condition_variable>
#include <mutex>
#include <optional>
#include <set>

#include "engine/pipeline/analysis_store.h"

namespace weft {

/// Two faces of one store. Whoever asks the taker's for a matte that is not there yet waits for it;
/// the maker's holds the maker back while more than kMostAhead of its frames have not been asked
/// for, so that both find pictures and motion in their caches. The maker never waits while a taker
/// does. Thread-safe.
class MatteFeed {
  public:
    static constexpr int kMostAhead = 2;  ///< Frames.

    explicit MatteFeed(AnalysisStore& store) : maker_(*this), taker_(*this), store_(store) {}

    /// get() never waits.
    [[nodiscard]] AnalysisStore& maker() { return maker_; }
    /// get() fails with the maker's error where that has made it impossible.
    [[nodiscard]] AnalysisStore& taker() { return taker_; }

    /// The maker has made all, or failed: nobody waits for it any more.
    void end(Status made);
    /// The takers are done: the maker is not held back. `failed`: it need not go on either, and its
    /// put() fails.
    void release(bool failed);
    /// What end() was told; nothing if the maker stopped because the takers had failed.
    [[nodiscard]] Status made() const;

  private:
    class Face : public AnalysisStore {
      public:
        explicit Face(MatteFeed& feed) : feed_(feed) {}
        [[nodiscard]] bool has(const AnalysisKey& key) const override;
        [[nodiscard]] Status put(const AnalysisKey& key, const Bytes& bytes) override;
        [[nodiscard]] Expected<Bytes> get(const AnalysisKey& key) const override;

      protected:
        MatteFeed& feed_;
    };
    class Maker final : public Face {
      public:
        using Face::Face;
        [[nodiscard]] Status put(const AnalysisKey& key, const Bytes& bytes) override;
    };
    class Taker final : public Face {
      public:
        using Face::Face;
        [[nodiscard]] Expected<Bytes> get(const AnalysisKey& key) const override;
    };

    [[nodiscard]] Status wait_until_wanted(int frame);
    [[nodiscard]] Status wait_for(const AnalysisKey& key);

    Maker maker_;
    Taker taker_;
    AnalysisStore& store_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::set<int> not_asked_for_;  // frames that the maker has put
    int waiting_ = 0;              // takers
    bool released_ = false, abandoned_ = false;
    std::optional<Status> made_;
};

}  // namespace weft
