#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope::reports {

/// A picture of numbers, without a word on who draws it: panels side by side, each with points
/// joined by lines, or a map. Texts are UTF-8.
struct Plot {
    enum class Line { full, dashed, none };

    struct Series {
        std::string name;  ///< of the legend; the same name has the same colour in all panels
        std::vector<double> x{}, y{};  ///< finite, and > 0 on a logarithmic axis
        std::vector<double> error{};   ///< of y: half the length of its bar; NaN: none
        Line line = Line::full;
        bool has_marks = true;
        bool is_crossed_out = false;  ///< large crosses are its marks: what has no true place
        std::string colour_of{};      ///< another series' name; it then has no entry in the legend
    };
    /// A range of y that is known from elsewhere: a strip, or a line where both ends agree.
    struct Band {
        double low, high;
        std::string name;  ///< written beside it
    };
    struct Axis {
        bool is_logarithmic = true;
        std::vector<std::string> categories{};  ///< at 0, 1, 2, ...; then the axis is linear
        /// Of y, linear: where bands beside the points would leave them less than a quarter of the
        /// axis, it is interrupted between them, and the bands stand in a strip of their own.
        bool breaks_before_bands = false;
    };
    /// Values over two lists of categories.
    struct Map {
        struct Value {
            double value;  ///< NaN: missing, and shown as that
            std::string text, mark;
        };
        std::vector<std::string> x_labels, y_labels;
        std::vector<Value> values;  ///< row by row from below, [y_labels][x_labels]
        std::string title;          ///< of the colour bar
        double low = 0.0, high = 1.0;
        bool is_signed = false;  ///< then low = -high, and zero is the neutral colour
    };
    struct Panel {
        std::string title, x_title, y_title;  ///< axes with units
        std::vector<Series> series{};
        Axis x_axis{}, y_axis{};
        std::vector<Band> bands{};
        std::optional<Map> map{};  ///< instead of series
    };
    std::string title;
    std::vector<Panel> panels;
    int columns = 3;                     ///< panels in a row
    bool legend_above = false;           ///< else inside the first panel
    std::vector<std::string> caption{};  ///< lines below the panels
};

/// Draws a plot into <path>.png and <path>.svg and returns the two names. Empty in a program that
/// was built without pictures.
using DrawPlot = std::function<std::vector<std::string>(const Plot&, const std::string& path)>;

}  // namespace spheroscope::reports
