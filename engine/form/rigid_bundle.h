#pragma once
// Bundle adjustment of one rigid surface over its frames. Internal to the folder.

#include <Eigen/Dense>
#include <vector>

#include "engine/form/rigid_fit.h"

namespace weft {

constexpr double kOutlierSquare = 25;  ///< Of an error, in σ: there it counts by half.

/// From the reference frame's view space into a frame's.
struct RigidPose {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

/// What is believed before anything is measured: normal distributions, by their deviations.
struct RigidPrior {
    double slope = 1;  ///< Of g.
    double relief =
        0.3;  ///< Of the coefficients of order 2; higher ones go down with their square.
    double tangent = 0.91, tangent_deviation = 0.35;  ///< A field of view of 49° (32° to 64°).
};

/// Matches, the surface and the poses that explain them. The cost is twice the negative logarithm
/// of the posterior, up to a constant: squares of errors in units of `sigma_px`, bounded where they
/// are outliers (Geman & McClure 1985), and those of the prior. All matches of one frame count as
/// kIndependent numbers, since a track's errors are alike in a neighbourhood.
class RigidBundle {
  public:
    static constexpr double kIndependent = 8;

    /// `frames` must outlive the bundle; `poses`: one for each of them.
    RigidBundle(const std::vector<FrameMatches>& frames, RigidSurface surface,
                std::vector<RigidPose> poses, const RigidPrior& prior, double sigma_px);

    /// At most so many steps of Levenberg–Marquardt.
    void descend(int most_steps);
    [[nodiscard]] double cost() const { return cost_; }
    [[nodiscard]] const RigidSurface& surface() const { return surface_; }
    [[nodiscard]] const std::vector<RigidPose>& poses() const { return poses_; }
    /// Root of the median square of the errors, px.
    [[nodiscard]] double residual_px() const;
    /// Half the Hessian of the cost over slopes, relief and tangent, the poses marginalised.
    [[nodiscard]] Eigen::MatrixXd information() const;
    /// The surface with another shape: slopes, relief and tangent moved by `step`.
    [[nodiscard]] RigidSurface moved(const Eigen::VectorXd& step) const;

  private:
    struct FrameSystem {
        Eigen::Matrix<double, 6, 6> poses;
        Eigen::Matrix<double, 6, 1> right;
        Eigen::MatrixXd mixed;  // 6 × shared
    };
    struct System {
        std::vector<FrameSystem> frames;
        Eigen::MatrixXd shared;
        Eigen::VectorXd right;
    };
    [[nodiscard]] int shared_count() const { return 3 + static_cast<int>(surface_.relief.size()); }
    [[nodiscard]] System linearised() const;
    [[nodiscard]] double cost_of(const RigidSurface& surface,
                                 const std::vector<RigidPose>& poses) const;
    [[nodiscard]] double prior_cost(const RigidSurface& surface) const;
    [[nodiscard]] Eigen::VectorXd prior_weights() const;
    // What the prior has the shape be, less what it is.
    [[nodiscard]] Eigen::VectorXd prior_left(const RigidSurface& surface) const;

    const std::vector<FrameMatches>* frames_;
    std::vector<std::vector<double>> terms_;  // nearness_terms() of all places, by frame
    RigidSurface surface_;
    std::vector<RigidPose> poses_;
    RigidPrior prior_;
    double sigma_px_;
    double cost_ = 0;
};

}  // namespace weft
