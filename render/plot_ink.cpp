#include "render/plot_ink.hpp"

#include "render/plot_axes.hpp"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

namespace spheroscope::render {

void use_brush(vtkContext2D& painter, Rgb colour) {
    painter.GetPen()->SetLineType(vtkPen::NO_PEN);
    painter.GetBrush()->SetColor(colour.r, colour.g, colour.b, 255);
}
void use_pen(vtkContext2D& painter, Rgb colour, float width_px) {
    painter.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    painter.GetPen()->SetColor(colour.r, colour.g, colour.b, 255);
    painter.GetPen()->SetWidth(width_px);
}
void write(vtkContext2D& painter, double x, double y, const std::string& text, int size, Rgb colour,
           bool is_centred) {
    vtkNew<vtkTextProperty> style;
    set_font(style, size);
    style->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
    if (is_centred)
        style->SetJustificationToCentered();
    else
        style->SetJustificationToLeft();
    style->SetVerticalJustificationToCentered();
    painter.ApplyTextProp(style);
    painter.DrawString(static_cast<float>(x), static_cast<float>(y), text);
}
void fill(vtkContext2D& painter, double x0, double y0, double x1, double y1) {
    painter.DrawRect(static_cast<float>(x0), static_cast<float>(y0), static_cast<float>(x1 - x0),
                     static_cast<float>(y1 - y0));
}

std::string fitting(TextPainter& text, const std::string& words, int size, double width_px, Cut cut,
                    FontStyle font) {
    constexpr double hinting = 0.98;  // VTK hints letters to whole pixels, seldom wider than this
    return shortened(text, words, {static_cast<double>(size), k_plot_ink, font}, hinting * width_px,
                     cut);
}

}  // namespace spheroscope::render
