#include "texture_db/describe/descriptor_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/core/setting.h"

namespace weft {
namespace {

constexpr int kMostOutputs = 40;
constexpr double kShrinkage = 0.4;            // best of 0.1 and 0.4 on the evaluation photographs
constexpr std::uint32_t kMagic = 0x31444c57;  // "WLD1"
constexpr float kNowhere = 1e4f;              // centre of a material with too few samples

// The lower triangle L with L·Lᵀ = a, in place.
bool cholesky(std::vector<double>& a, std::size_t n) {
    for (std::size_t j = 0; j < n; ++j) {
        double d = a[j * n + j];
        for (std::size_t k = 0; k < j; ++k)
            d -= a[j * n + k] * a[j * n + k];
        if (!(d > 0)) return false;
        d = std::sqrt(d);
        a[j * n + j] = d;
        for (std::size_t i = j + 1; i < n; ++i) {
            double s = a[i * n + j];
            for (std::size_t k = 0; k < j; ++k)
                s -= a[i * n + k] * a[j * n + k];
            a[i * n + j] = s / d;
        }
    }
    return true;
}

// x := L⁻¹ x
void solve_lower(const std::vector<double>& l, std::size_t n, double* x) {
    for (std::size_t i = 0; i < n; ++i) {
        double s = x[i];
        for (std::size_t k = 0; k < i; ++k)
            s -= l[i * n + k] * x[k];
        x[i] = s / l[i * n + i];
    }
}
// x := L⁻ᵀ x
void solve_upper(const std::vector<double>& l, std::size_t n, double* x) {
    for (std::size_t i = n; i-- > 0;) {
        double s = x[i];
        for (std::size_t k = i + 1; k < n; ++k)
            s -= l[k * n + i] * x[k];
        x[i] = s / l[i * n + i];
    }
}

struct Standardised {
    std::vector<std::vector<float>> rows;
    std::vector<float> mean, deviation;
};

float squashed(float v) {
    return std::clamp(v, -6.0f, 6.0f);
}

Standardised standardise(const LabelledFeatures& data) {
    const std::size_t n = data.features.size(), d = data.features.front().size();
    std::vector<double> sum(d), squares(d);
    for (const auto& row : data.features) {
        for (std::size_t k = 0; k < d; ++k) {
            sum[k] += row[k];
            squares[k] += static_cast<double>(row[k]) * row[k];
        }
    }
    Standardised s;
    for (std::size_t k = 0; k < d; ++k) {
        const double mean = sum[k] / static_cast<double>(n);
        const double variance = squares[k] / static_cast<double>(n) - mean * mean;
        s.mean.push_back(static_cast<float>(mean));
        s.deviation.push_back(static_cast<float>(std::sqrt(std::max(variance, 1e-8))));
    }
    s.rows.resize(n);
    parallel_for(n, [&](std::size_t i) {
        s.rows[i].resize(d);
        for (std::size_t k = 0; k < d; ++k)
            s.rows[i][k] = squashed((data.features[i][k] - s.mean[k]) / s.deviation[k]);
    });
    return s;
}

struct Classes {
    std::vector<std::vector<double>> centres;
    std::vector<double> weights;
};

Classes centres_of(const LabelledFeatures& data, const Standardised& s, std::size_t d) {
    Classes c;
    c.centres.assign(data.materials.size(), std::vector<double>(d));
    c.weights.assign(data.materials.size(), 0);
    for (std::size_t i = 0; i < s.rows.size(); ++i) {
        const auto m = static_cast<std::size_t>(data.labels[i]);
        const double w = data.weights[i];
        c.weights[m] += w;
        for (std::size_t k = 0; k < d; ++k)
            c.centres[m][k] += w * s.rows[i][k];
    }
    for (std::size_t m = 0; m < c.centres.size(); ++m) {
        for (double& v : c.centres[m])
            v /= std::max(c.weights[m], 1e-9);
    }
    return c;
}

// The pooled covariance within the materials, each weighted by the square root of its total weight,
// shrunk towards its diagonal mean.
std::vector<double> within(const LabelledFeatures& data, const Standardised& s, const Classes& c,
                           std::size_t d) {
    std::vector<double> w(d * d);
    double total = 0;
    std::vector<double> each(s.rows.size());
    for (std::size_t i = 0; i < s.rows.size(); ++i) {
        const auto m = static_cast<std::size_t>(data.labels[i]);
        each[i] = data.weights[i] / std::sqrt(std::max(c.weights[m], 1.0));
        total += each[i];
    }
    std::vector<std::vector<float>> difference(s.rows.size());
    parallel_for(s.rows.size(), [&](std::size_t i) {
        const auto& centre = c.centres[static_cast<std::size_t>(data.labels[i])];
        difference[i].resize(d);
        for (std::size_t k = 0; k < d; ++k)
            difference[i][k] = static_cast<float>((s.rows[i][k] - centre[k]) * std::sqrt(each[i]));
    });
    // Each row of the matrix is summed by one thread in the order of the samples.
    parallel_for(d, [&](std::size_t r) {
        double* row = w.data() + r * d;
        for (const auto& x : difference) {
            const double v = x[r];
            if (v == 0) continue;
            for (std::size_t k = 0; k <= r; ++k)
                row[k] += v * x[k];
        }
    });
    double trace = 0;
    for (std::size_t r = 0; r < d; ++r)
        trace += w[r * d + r];
    const double mean = trace / (total * static_cast<double>(d));
    for (std::size_t r = 0; r < d; ++r) {
        for (std::size_t k = 0; k <= r; ++k) {
            double v = w[r * d + k] / total * (1 - kShrinkage);
            if (r == k) v += kShrinkage * mean + 1e-6;
            w[r * d + k] = w[k * d + r] = v;
        }
    }
    return w;
}

template <class T>
void append(std::vector<std::byte>& out, const std::vector<T>& values) {
    const auto count = static_cast<std::uint32_t>(values.size());
    const auto* c = reinterpret_cast<const std::byte*>(&count);
    out.insert(out.end(), c, c + sizeof count);
    const auto* p = reinterpret_cast<const std::byte*>(values.data());
    out.insert(out.end(), p, p + values.size() * sizeof(T));
}

template <class T>
bool take(std::span<const std::byte>& in, std::vector<T>& values) {
    std::uint32_t count = 0;
    if (in.size() < sizeof count) return false;
    std::memcpy(&count, in.data(), sizeof count);
    in = in.subspan(sizeof count);
    if (in.size() / sizeof(T) < count) return false;
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), in.data(), count * sizeof(T));
    in = in.subspan(count * sizeof(T));
    return true;
}

}  // namespace

std::vector<float> DescriptorModel::describe(std::span<const float> features) const {
    std::vector<float> y(static_cast<std::size_t>(outputs));
    if (static_cast<int>(features.size()) != inputs) return y;
    const auto d = static_cast<std::size_t>(inputs);
    std::vector<float> x(d);
    for (std::size_t k = 0; k < d; ++k)
        x[k] = squashed((features[k] - mean[k]) / deviation[k]);
    for (std::size_t o = 0; o < y.size(); ++o) {
        double sum = 0;
        for (std::size_t k = 0; k < d; ++k)
            sum += static_cast<double>(projection[o * d + k]) * x[k];
        y[o] = static_cast<float>(sum);
    }
    return y;
}

std::vector<float> DescriptorModel::distances_to_centres(std::span<const float> descriptor) const {
    std::vector<float> out;
    const auto n = static_cast<std::size_t>(outputs);
    for (std::size_t m = 0; m < materials.size(); ++m) {
        float sum = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const float d = descriptor[k] - centres[m * n + k];
            sum += d * d;
        }
        out.push_back(std::sqrt(sum));
    }
    return out;
}

std::vector<std::byte> DescriptorModel::to_bytes() const {
    std::vector<std::byte> out;
    append(out, std::vector<std::uint32_t>{kMagic, static_cast<std::uint32_t>(inputs),
                                           static_cast<std::uint32_t>(outputs)});
    append(out, mean);
    append(out, deviation);
    append(out, projection);
    append(out, centres);
    std::vector<char> names;
    for (const std::string& name : materials) {
        names.insert(names.end(), name.begin(), name.end());
        names.push_back('\n');
    }
    append(out, names);
    return out;
}

Expected<DescriptorModel> DescriptorModel::from_bytes(std::span<const std::byte> bytes) {
    DescriptorModel m;
    std::vector<std::uint32_t> head;
    std::vector<char> names;
    const bool read = take(bytes, head) && head.size() == 3 && head[0] == kMagic &&
                      take(bytes, m.mean) && take(bytes, m.deviation) &&
                      take(bytes, m.projection) && take(bytes, m.centres) && take(bytes, names);
    if (read) {
        m.inputs = static_cast<int>(head[1]);
        m.outputs = static_cast<int>(head[2]);
        std::string name;
        for (const char c : names) {
            if (c == '\n')
                m.materials.push_back(std::exchange(name, {}));
            else
                name += c;
        }
    }
    const auto d = m.mean.size(), o = static_cast<std::size_t>(std::max(m.outputs, 0));
    if (!read || static_cast<std::size_t>(m.inputs) != d || m.deviation.size() != d ||
        m.projection.size() != d * o || m.centres.size() != m.materials.size() * o) {
        return fail(ErrorCode::kUnreadable, "The descriptor is damaged.",
                    "Train it again" + by({{setting::kTrainLibrary}}) + ".");
    }
    return m;
}

Expected<DescriptorModel> learn_descriptor(const LabelledFeatures& data) {
    std::vector<int> counts(data.materials.size());
    for (const int label : data.labels)
        ++counts[static_cast<std::size_t>(label)];
    if (std::count_if(counts.begin(), counts.end(), [](int n) { return n >= 10; }) < 2) {
        return fail(ErrorCode::kUsage, "Training needs at least two materials of ten samples each.",
                    "Import more textures first.");
    }
    const std::size_t d = data.features.front().size();
    const Standardised s = standardise(data);
    const Classes classes = centres_of(data, s, d);
    std::vector<double> l = within(data, s, classes, d);
    if (!cholesky(l, d))
        return fail(ErrorCode::kRenderFailed, "The samples are too similar to train on.",
                    "Import more varied textures.");

    // Between-class directions, whitened: B = L⁻¹ (c_m − c), at most as many as materials; their
    // singular vectors from the small matrix BᵀB.
    std::vector<double> middle(d);
    for (const auto& centre : classes.centres)
        for (std::size_t k = 0; k < d; ++k)
            middle[k] += centre[k] / static_cast<double>(classes.centres.size());
    std::vector<std::vector<double>> b;
    for (std::size_t m = 0; m < classes.centres.size(); ++m) {
        if (counts[m] < 10) continue;
        std::vector<double> v(d);
        for (std::size_t k = 0; k < d; ++k)
            v[k] = classes.centres[m][k] - middle[k];
        solve_lower(l, d, v.data());
        b.push_back(std::move(v));
    }
    const int n = static_cast<int>(b.size());
    cv::Mat gram(n, n, CV_64F), values, vectors;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k < d; ++k)
                sum += b[static_cast<std::size_t>(i)][k] * b[static_cast<std::size_t>(j)][k];
            gram.at<double>(i, j) = sum;
        }
    }
    cv::eigen(gram, values, vectors);
    DescriptorModel model;
    model.inputs = static_cast<int>(d);
    model.mean = s.mean;
    model.deviation = s.deviation;
    model.materials = data.materials;
    for (int i = 0; i < std::min(n, kMostOutputs); ++i) {
        const double value = values.at<double>(i);
        if (value < 1e-6 * values.at<double>(0)) break;
        std::vector<double> direction(d);
        for (int j = 0; j < n; ++j) {
            for (std::size_t k = 0; k < d; ++k)
                direction[k] += vectors.at<double>(i, j) * b[static_cast<std::size_t>(j)][k];
        }
        for (double& v : direction)
            v /= std::sqrt(value);
        solve_upper(l, d, direction.data());
        for (const double v : direction)
            model.projection.push_back(static_cast<float>(v));
        ++model.outputs;
    }
    for (std::size_t m = 0; m < classes.centres.size(); ++m) {
        const auto& centre = classes.centres[m];
        for (int o = 0; o < model.outputs; ++o) {
            if (counts[m] < 10) {
                model.centres.push_back(kNowhere);
                continue;
            }
            double sum = 0;
            for (std::size_t k = 0; k < d; ++k)
                sum += static_cast<double>(model.projection[static_cast<std::size_t>(o) * d + k]) *
                       centre[k];
            model.centres.push_back(static_cast<float>(sum));
        }
    }
    return model;
}

}  // namespace weft
