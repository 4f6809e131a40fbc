#include "bench/study/svg_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr double kWidth = 860, kHeight = 320;
constexpr double kLeft = 62, kRight = 230, kTop = 34, kBottom = 44;

// A step of 1, 2 or 5 times a power of ten that divides the span into at most `most` parts.
double nice_step(double span, int most) {
    const double rough = span / most;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double m : {1.0, 2.0, 5.0}) {
        if (m * power >= rough * 0.999) return m * power;
    }
    return 10 * power;
}

std::string number_text(double v) {
    return fmt::format("{:g}", std::round(v * 1e6) / 1e6);
}

struct Extent {
    double low = 1e300, high = -1e300;
    void add(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
    [[nodiscard]] bool empty() const { return high < low; }
};

class LinePlot {
  public:
    explicit LinePlot(const LineChart& chart) : chart_(chart) {}

    std::string draw() {
        fit();
        std::string out = fmt::format(
            "<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">"
            "<text class=\"title\" x=\"{}\" y=\"18\">{}</text>",
            kWidth, kHeight, html_text(chart_.title), kLeft, html_text(chart_.title));
        if (x_.empty() || y_.empty()) {
            return out + fmt::format("<text x=\"{}\" y=\"{}\">Not measured.</text></svg>", kLeft,
                                     kHeight / 2);
        }
        out += band() + grid();
        for (const ChartLine& line : chart_.lines)
            out += path(line);
        return out + legend() + "</svg>";
    }

  private:
    [[nodiscard]] std::optional<double> shown(const std::optional<double>& v) const {
        if (!v || !std::isfinite(*v)) return std::nullopt;
        if (!chart_.logarithmic) return v;
        if (*v <= 0) return std::nullopt;
        return std::log10(*v);
    }

    void fit() {
        for (const ChartLine& line : chart_.lines) {
            for (const auto& [x, y] : line.points) {
                const auto v = shown(y);
                if (!v) continue;
                x_.add(x);
                y_.add(*v);
            }
        }
        if (y_.empty()) return;
        if (chart_.band) {
            y_.add(*shown(chart_.band->first));
            y_.add(*shown(chart_.band->second));
        }
        if (chart_.logarithmic) {
            y_.low = std::floor(y_.low * 2) / 2;
            y_.high = std::ceil(y_.high * 2) / 2;
        } else {
            if (y_.low > 0 && y_.low < 0.5 * y_.high) y_.low = 0;
            const double rim = 0.06 * std::max(1e-6, y_.high - y_.low);
            y_.high += rim;
            if (y_.low != 0) y_.low -= rim;
        }
        if (y_.high <= y_.low) y_.high = y_.low + 1;
        if (x_.high <= x_.low) x_.high = x_.low + 1;
    }

    [[nodiscard]] double px(double x) const {
        return kLeft + (x - x_.low) / (x_.high - x_.low) * (kWidth - kLeft - kRight);
    }
    [[nodiscard]] double py(double v) const {
        return kHeight - kBottom - (v - y_.low) / (y_.high - y_.low) * (kHeight - kTop - kBottom);
    }

    [[nodiscard]] std::string band() const {
        if (!chart_.band) return {};
        const double top = py(*shown(chart_.band->second)), low = py(*shown(chart_.band->first));
        return fmt::format(
            "<rect class=\"band\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>",
            kLeft, top, kWidth - kLeft - kRight, low - top);
    }

    [[nodiscard]] std::string y_line(double v, double value) const {
        const double y = py(v);
        return fmt::format(
            "<line class=\"grid\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>"
            "<text class=\"tick\" text-anchor=\"end\" x=\"{}\" y=\"{:.1f}\">{}</text>",
            kLeft, kWidth - kRight, y, y, kLeft - 6, y + 4, number_text(value));
    }

    [[nodiscard]] std::string grid() const {
        std::string out;
        if (chart_.logarithmic) {
            for (int e = static_cast<int>(std::floor(y_.low)); e <= y_.high; ++e) {
                for (const double m : {1.0, 3.0}) {
                    const double value = m * std::pow(10.0, e), v = std::log10(value);
                    if (v >= y_.low - 1e-9 && v <= y_.high + 1e-9) out += y_line(v, value);
                }
            }
        } else {
            const double step = nice_step(y_.high - y_.low, 6);
            for (double v = std::ceil(y_.low / step) * step; v <= y_.high; v += step)
                out += y_line(v, v);
        }
        const double step = std::max(1.0, nice_step(x_.high - x_.low, 10));
        for (double x = std::ceil(x_.low / step) * step; x <= x_.high; x += step) {
            out += fmt::format(
                "<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{}\">{}</text>",
                px(x), kHeight - kBottom + 16, number_text(x));
        }
        return out + fmt::format(
                         "<text class=\"label\" text-anchor=\"middle\" x=\"{}\" y=\"{}\">{}</text>"
                         "<text class=\"label\" text-anchor=\"middle\" transform=\"translate(14 "
                         "{}) rotate(-90)\">{}</text>",
                         (kLeft + kWidth - kRight) / 2, kHeight - 8, html_text(chart_.x_label),
                         (kTop + kHeight - kBottom) / 2, html_text(chart_.y_label));
    }

    [[nodiscard]] static std::string style(const ChartLine& line) {
        return fmt::format("stroke=\"{}\" stroke-width=\"{}\"{}", line.colour,
                           line.strong ? 3.2 : 1.6, line.dashed ? " stroke-dasharray=\"5 3\"" : "");
    }

    [[nodiscard]] std::string path(const ChartLine& line) const {
        std::string d;
        bool down = false;
        int run = 0;
        std::string dots;
        for (std::size_t k = 0; k < line.points.size(); ++k) {
            const auto v = shown(line.points[k].second);
            if (!v) {
                down = false;
                continue;
            }
            d += fmt::format("{}{:.1f} {:.1f}", down ? "L" : "M", px(line.points[k].first), py(*v));
            run = down ? run + 1 : 0;
            down = true;
            const bool ends =
                k + 1 == line.points.size() || !shown(line.points[k + 1].second).has_value();
            if (run == 0 && ends) {
                dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>",
                                    px(line.points[k].first), py(*v), line.colour);
            }
        }
        return fmt::format("<path fill=\"none\" {} d=\"{}\"/>{}", style(line), d, dots);
    }

    [[nodiscard]] std::string legend() const {
        std::string out;
        double y = kTop + 6;
        for (const ChartLine& line : chart_.lines) {
            out += fmt::format(
                "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2}\" y2=\"{2}\" {3}/>"
                "<text class=\"key\" x=\"{4}\" y=\"{5}\">{6}</text>",
                kWidth - kRight + 14, kWidth - kRight + 40, y, style(line), kWidth - kRight + 46,
                y + 4, html_text(line.name));
            y += 20;
        }
        return out;
    }

    const LineChart& chart_;
    Extent x_, y_;
};

}  // namespace

std::string html_text(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string svg_of(const LineChart& chart) {
    return LinePlot(chart).draw();
}

std::string svg_of_bars(const std::string& title, const std::string& x_label,
                        const std::vector<Bar>& bars) {
    constexpr double kNames = 240, kValues = 130, kRow = 26, kBar = 16;
    double largest = 0;
    std::vector<std::pair<std::string, std::string>> keys;
    for (const Bar& bar : bars) {
        double sum = 0;
        for (const Bar::Part& part : bar.parts) {
            sum += part.value;
            const std::pair key(part.name, part.colour);
            if (!part.name.empty() && std::find(keys.begin(), keys.end(), key) == keys.end())
                keys.push_back(key);
        }
        largest = std::max(largest, sum);
    }
    const double top = keys.empty() ? 34 : 56;
    const double height = top + kRow * static_cast<double>(bars.size()) + 24;
    const double scale = (kWidth - kNames - kValues) / std::max(1e-9, largest);
    std::string out = fmt::format(
        "<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">"
        "<text class=\"title\" x=\"0\" y=\"18\">{}</text>",
        kWidth, height, html_text(title), html_text(title));
    double x = kNames;
    for (const auto& [name, colour] : keys) {
        out += fmt::format(
            "<rect x=\"{}\" y=\"32\" width=\"12\" height=\"12\" fill=\"{}\"/>"
            "<text class=\"key\" x=\"{}\" y=\"42\">{}</text>",
            x, colour, x + 17, html_text(name));
        x += 130;
    }
    double y = top;
    for (const Bar& bar : bars) {
        out += fmt::format("<text class=\"key\" text-anchor=\"end\" x=\"{}\" y=\"{}\">{}</text>",
                           kNames - 8, y + kBar - 4, html_text(bar.name));
        double at = kNames;
        for (const Bar::Part& part : bar.parts) {
            const double width = std::max(0.0, part.value) * scale;
            out += fmt::format(
                "<rect x=\"{:.1f}\" y=\"{}\" width=\"{:.2f}\" height=\"{}\" fill=\"{}\"/>", at, y,
                width, kBar, part.colour);
            at += width;
        }
        out += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{}\">{}</text>", at + 6,
                           y + kBar - 4, html_text(bar.label));
        y += kRow;
    }
    return out + fmt::format("<text class=\"label\" x=\"{}\" y=\"{}\">{}</text></svg>", kNames,
                             height - 6, html_text(x_label));
}

}  // namespace weft
