#pragma once

#include <functional>
#include <string>
#include <vector>

namespace spheroscope::reports {

/// A picture of numbers, without a word on who draws it: panels side by side, each with points
/// joined by lines. Texts are UTF-8.
struct Plot {
    enum class Axes { logarithmic, linear };
    struct Series {
        std::string name;  ///< of the legend; the same name has the same colour in all panels
        std::vector<double> x, y;  ///< finite; on logarithmic axes > 0
    };
    struct Panel {
        std::string title, x_title, y_title;  ///< axes with units
        std::vector<Series> series;
        Axes axes = Axes::logarithmic;
    };
    std::string title;
    std::vector<Panel> panels;
};

/// Draws a plot into <path>.png and <path>.svg and returns the two names. Empty in a program that
/// was built without pictures.
using DrawPlot = std::function<std::vector<std::string>(const Plot&, const std::string& path)>;

}  // namespace spheroscope::reports
