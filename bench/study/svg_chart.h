#pragma once
// Charts as inline SVG, for reports that are one file.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace weft {

/// `text` with &, <, > and " as HTML writes them.
[[nodiscard]] std::string html_text(const std::string& text);

struct ChartLine {
    std::string name;
    std::string colour;  ///< As CSS writes it.
    bool dashed = false;
    bool strong = false;
    std::vector<std::pair<double, std::optional<double>>> points;  ///< By ascending x.
};

struct LineChart {
    std::string title, x_label, y_label;
    bool logarithmic = false;  ///< The y axis; values of 0 and less are left out.
    std::optional<std::pair<double, double>> band;  ///< Shaded between two y: what is right.
    std::vector<ChartLine> lines;
};

/// An SVG of its own with a legend. A line is broken where a value is missing. With nothing to show
/// it says so.
[[nodiscard]] std::string svg_of(const LineChart& chart);

struct Bar {
    std::string name;
    struct Part {
        std::string name, colour;
        double value = 0;
    };
    std::vector<Part> parts;  ///< Laid one after the other.
    std::string label;        ///< After the bar.
};

/// Horizontal bars, one below the other; parts of one name share a colour and a legend entry.
[[nodiscard]] std::string svg_of_bars(const std::string& title, const std::string& x_label,
                                      const std::vector<Bar>& bars);

}  // namespace weft
