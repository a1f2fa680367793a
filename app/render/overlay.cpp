#include "render/overlay.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "render/canvas.h"

namespace isorelax::render {
namespace {

/// Lengths in points.
constexpr double kTextSize = 15;
constexpr double kEdge = 18;  ///< free at the picture's edge
constexpr double kPad = 10;   ///< between the panel's edge and what stands on it
constexpr double kBarWidth = 16;
constexpr double kTickLength = 4;
constexpr double kNoteGap = 6;
constexpr double kLine = 22;  ///< from baseline to baseline
/// Text smaller than this cannot be read, however small the picture.
constexpr double kLeastTextPixels = 10.5;

constexpr const char* kBacks = "upside down";

struct Inks {
  Color text;
  Color dim;
};

constexpr Color kDarkInk{30, 33, 39};
constexpr Color kLightInk{232, 235, 240};

Inks inks_for(const Scene& scene) {
  const Color middle =
      scene.transparent ? Color{255, 255, 255} : mix(scene.background.top, scene.background.bottom, 0.5);
  const Color text = luminance(middle) < 0.2 ? kLightInk : kDarkInk;
  return {text, mix(middle, text, 0.62)};
}

/// A veil of the background's own colours behind what is written: seen only where a mesh stands behind it.
/// Where nobody knows what will be behind the picture, a light one that the dark ink can be read on.
void veil(Canvas& canvas, const Scene& scene, int top, PictureSize size) {
  if (scene.transparent) {
    canvas.fill(0, 0, canvas.image().width, canvas.image().height, {255, 255, 255}, 0.85);
    return;
  }
  const Background& background = scene.background;
  for (int y = 0; y < canvas.image().height; ++y) {
    const double below_top = std::clamp((top + y + 0.5) / size.height, 0.0, 1.0);
    canvas.fill(0, y, canvas.image().width, y + 1, mix(background.top, background.bottom, below_top), 0.85);
  }
}

/// Pixels per point for text and what stands beside it.
double text_scale(const Scene& scene, PictureSize size) {
  return std::max(pixels_per_point(scene, size), kLeastTextPixels / kTextSize);
}

/// Where everything of the legend goes, in pixels from the panel's upper left corner.
class LegendLayout {
 public:
  LegendLayout(const Legend& legend, PictureSize size, double scale)
      : legend_(legend), scale_(scale), font_(kTextSize * scale), title_(legend.title) {
    if (!legend.unit.empty()) title_ += " (" + legend.unit + ")";
    bar_height_ = std::round(std::clamp(0.42 * size.height, 40.0, 340 * scale));
    const int most = std::clamp(static_cast<int>(bar_height_ / (2.2 * kTextSize * scale)), 2, 7);
    ticks_ = legend_ticks(legend.coloring, most);
    measure();
  }

  [[nodiscard]] int width() const { return static_cast<int>(std::ceil(width_)); }
  [[nodiscard]] int height() const { return static_cast<int>(std::ceil(height_)); }

  /// The legend with its upper left corner at row `top` of the picture.
  Image paint(const Scene& scene, PictureSize size, int top) {
    const Inks inks = inks_for(scene);
    Canvas canvas(width(), height());
    veil(canvas, scene, top, size);
    double y = points(kPad) + font_.cap_height();
    canvas.text(font_, title_, points(kPad), y, Align::left, inks.text);
    y += points(0.4 * kLine);
    for (const Swatch& kind : legend_.kinds) y = swatch(canvas, kind.color, kind.text, y, inks);
    if (!legend_.kinds.empty()) return canvas.image();
    if (legend_.shows_above) y = swatch(canvas, kAboveRange, "above", y, inks);
    y = bar(canvas, y + points(0.4 * kLine), inks);
    if (legend_.shows_below) y = swatch(canvas, kBelowRange, "below", y, inks);
    if (legend_.shows_missing) y = swatch(canvas, kNoValue, "no value", y, inks);
    if (legend_.shows_backs) swatch(canvas, kBackColor, kBacks, y, inks);
    return canvas.image();
  }

 private:
  [[nodiscard]] double points(double length) const { return length * scale_; }

  /// Word beside a tick: those of the two ends.
  [[nodiscard]] std::string note_at(const Tick& tick) const {
    if (tick.position == 0) return legend_.low_note;
    return tick.position == 1 ? legend_.high_note : std::string();
  }

  void measure_kinds() {
    double labels = 0;
    for (const Swatch& kind : legend_.kinds) labels = std::max(labels, font_.width(kind.text));
    width_ = std::max(font_.width(title_), points(kBarWidth + 2 * kTickLength) + labels) + points(2 * kPad);
    height_ =
        points(2 * kPad + (0.4 + static_cast<double>(legend_.kinds.size())) * kLine) + font_.cap_height();
  }

  void measure() {
    if (!legend_.kinds.empty()) return measure_kinds();
    double labels = 0;
    for (const Tick& tick : ticks_) {
      const std::string note = note_at(tick);
      labels = std::max(labels,
                        font_.width(tick.text) + (note.empty() ? 0 : points(kNoteGap) + font_.width(note)));
    }
    const int rows = legend_.shows_above + legend_.shows_below + legend_.shows_missing + legend_.shows_backs;
    if (legend_.shows_backs) labels = std::max(labels, font_.width(kBacks));
    if (legend_.shows_missing) labels = std::max(labels, font_.width("no value"));
    if (legend_.shows_above || legend_.shows_below) labels = std::max(labels, font_.width("above"));
    const double with_labels = points(kBarWidth + 2 * kTickLength) + labels;
    width_ = std::max(font_.width(title_), with_labels) + points(2 * kPad);
    height_ = points(2 * kPad + 1.1 * kLine + rows * kLine) + font_.cap_height() + bar_height_;
  }

  double swatch(Canvas& canvas, Color color, const std::string& text, double y, const Inks& inks) {
    const double x = points(kPad);
    const double middle = y + 0.5 * points(kLine);
    const double half = 0.3 * points(kLine);
    canvas.fill(x, std::round(middle - half), x + std::round(points(kBarWidth)), std::round(middle + half),
                color);
    canvas.text(font_, text, x + points(kBarWidth + 2 * kTickLength), middle + 0.5 * font_.cap_height(),
                Align::left, inks.dim);
    return y + points(kLine);
  }

  double bar(Canvas& canvas, double y, const Inks& inks) {
    const double x0 = std::round(points(kPad));
    const double x1 = x0 + std::round(points(kBarWidth));
    const double top = std::round(y);
    const double line = std::max(1.0, std::round(scale_));
    canvas.fill(x0 - line, top - line, x1 + line, top + bar_height_ + line, inks.dim);
    for (double row = 0; row < bar_height_; ++row)
      canvas.fill(x0, top + row, x1, top + row + 1,
                  color_at(legend_.coloring, 1 - (row + 0.5) / bar_height_));
    for (const Tick& tick : ticks_) {
      const double at = top + (1 - tick.position) * bar_height_;
      canvas.fill(x1, std::round(at - 0.5 * line), x1 + points(kTickLength),
                  std::round(at - 0.5 * line) + line, inks.dim);
      const double x = x1 + points(2 * kTickLength);
      const double baseline = at + 0.5 * font_.cap_height();
      canvas.text(font_, tick.text, x, baseline, Align::left, inks.text);
      canvas.text(font_, note_at(tick), x + font_.width(tick.text) + points(kNoteGap), baseline, Align::left,
                  inks.dim);
    }
    return top + bar_height_ + points(0.3 * kLine);
  }

  const Legend& legend_;
  double scale_;
  Font font_;
  std::string title_;
  std::vector<Tick> ticks_;
  double bar_height_ = 0;
  double width_ = 0;
  double height_ = 0;
};

Overlay make_caption(const Scene& scene, PictureSize size, double scale) {
  Font font(kTextSize * scale);
  const double pad = 0.5 * kPad * scale;
  const std::string caption = font.fitted(scene.caption, size.width - 2 * kEdge * scale);
  const int width = static_cast<int>(std::ceil(font.width(caption) + 2 * pad));
  const int height = static_cast<int>(std::ceil(kLine * scale));
  const int edge = static_cast<int>(std::lround(kEdge * scale - pad));
  const int top = size.height - edge - height - static_cast<int>(std::lround(scene.caption_lift * scale));
  Canvas canvas(width, height);
  veil(canvas, scene, top, size);
  canvas.text(font, caption, pad, 0.5 * (height + font.cap_height()), Align::left, inks_for(scene).text);
  return {canvas.image(), edge, top};
}

void disc(Canvas& canvas, double x, double y, double radius, Color color) {
  for (double row = -radius; row < radius; ++row) {
    const double middle = std::min(row + 0.5, radius);
    const double half = std::sqrt(std::max(0.0, radius * radius - middle * middle));
    canvas.fill(x - half, y + row, x + half, y + std::min(row + 1, radius), color);
  }
}

/// A dot and its meaning in each row, as many rows as have room.
Overlay make_key(const Scene& scene, PictureSize size, double scale) {
  Font font(kTextSize * scale);
  const double pad = 0.5 * kPad * scale;
  const double indent = pad + kBarWidth * scale;
  double width = 0;
  for (const Swatch& kind : scene.key) width = std::max(width, font.width(kind.text));
  const double line = 0.9 * kLine * scale;
  const double caption = scene.caption.empty() ? 0 : kLine * scale;
  const double bottom = kEdge * scale - pad + scene.caption_lift * scale + caption;
  const auto room = static_cast<std::size_t>(std::max(1.0, 0.5 * size.height / line));
  const std::size_t rows = std::min(scene.key.size(), room);
  const int height = static_cast<int>(std::ceil(static_cast<double>(rows) * line));
  const int top = static_cast<int>(std::lround(size.height - bottom)) - height;
  Canvas canvas(static_cast<int>(std::ceil(indent + width + pad)), height);
  veil(canvas, scene, top, size);
  const Inks inks = inks_for(scene);
  for (std::size_t k = 0; k < rows; ++k) {
    const double middle = (static_cast<double>(k) + 0.5) * line;
    disc(canvas, pad + 4 * scale, middle, 4 * scale, scene.key[k].color);
    canvas.text(font, scene.key[k].text, indent, middle + 0.5 * font.cap_height(), Align::left, inks.text);
  }
  return {canvas.image(), static_cast<int>(std::lround(kEdge * scale - pad)), top};
}

/// Lines at the upper left, in so much of the picture's width; a tab begins the second column, whose numbers
/// end at one edge. Where both columns do not fit, the numbers stay whole.
Overlay make_notes(const Scene& scene, PictureSize size, double scale, double room) {
  Font font(kTextSize * scale);
  const double pad = 0.5 * kPad * scale;
  const auto halves = [](const std::string& line) {
    const std::size_t tab = std::min(line.find('\t'), line.size());
    return std::pair{line.substr(0, tab), tab == line.size() ? std::string() : line.substr(tab + 1)};
  };
  double whole = 0, left = 0, right = 0;
  for (const std::string& line : scene.notes) {
    const auto [name, number] = halves(line);
    if (number.empty())
      whole = std::max(whole, font.width(name));
    else
      left = std::max(left, font.width(name)), right = std::max(right, font.width(number));
  }
  room -= 2 * kEdge * scale;
  const double gap = (left + right + 2 * kPad * scale <= room ? 2 : 1) * kPad * scale;
  const double inner = std::min(room, std::max(whole, right > 0 ? left + gap + right : 0.0));
  const int width = static_cast<int>(std::ceil(inner + 2 * pad));
  const int height = static_cast<int>(std::ceil(scale * kLine * static_cast<double>(scene.notes.size())));
  const int edge = static_cast<int>(std::lround(kEdge * scale - pad));
  Canvas canvas(std::clamp(width, 1, size.width), std::clamp(height, 1, size.height));
  veil(canvas, scene, edge, size);
  const Inks inks = inks_for(scene);
  double y = 0.5 * (kLine * scale + font.cap_height());
  for (const std::string& line : scene.notes) {
    const auto [name, number] = halves(line);
    const std::string shown = font.fitted(name, number.empty() ? inner : inner - gap - font.width(number));
    canvas.text(font, shown, pad, y, Align::left, number.empty() ? inks.text : inks.dim);
    canvas.text(font, number, pad + inner, y, Align::right, inks.text);
    y += kLine * scale;
  }
  return {canvas.image(), edge, edge};
}

}  // namespace

double pixels_per_point(const Scene& scene, PictureSize size) {
  return scene.pixels_per_point > 0 ? scene.pixels_per_point : std::min(size.width, size.height) / 720.0;
}

std::vector<Overlay> make_overlays(const Scene& scene, PictureSize size) {
  const double scale = text_scale(scene, size);
  std::vector<Overlay> overlays;
  if (scene.legend) {
    LegendLayout layout(*scene.legend, size, scale);
    const int edge = static_cast<int>(std::lround((kEdge - kPad) * scale));
    const int covered = static_cast<int>(std::lround(scene.legend_top * scale));
    // Lower than the middle where it has to be, but not out of the picture.
    const int top =
        std::max((size.height - layout.height()) / 2, std::min(covered, size.height - layout.height()));
    overlays.push_back({layout.paint(scene, size, top), size.width - edge - layout.width(), top});
  }
  if (!scene.caption.empty()) overlays.push_back(make_caption(scene, size, scale));
  if (!scene.key.empty()) overlays.push_back(make_key(scene, size, scale));
  if (!scene.notes.empty()) {
    const double bottom = (kEdge + kLine * static_cast<double>(scene.notes.size())) * scale;
    const bool beside_legend = scene.legend && overlays.front().top < bottom;
    overlays.push_back(make_notes(scene, size, scale, beside_legend ? overlays.front().left : size.width));
  }
  return overlays;
}

double legend_share(const Scene& scene, PictureSize size) {
  if (!scene.legend || size.height <= 0) return 0;
  const double scale = text_scale(scene, size);
  const LegendLayout layout(*scene.legend, size, scale);
  return (layout.width() + (kEdge - kPad) * scale) / size.height;
}

double caption_share(const Scene& scene, PictureSize size) {
  if (scene.caption.empty() || size.height <= 0) return 0;
  return (kEdge + kLine + kPad) * text_scale(scene, size) / size.height;
}

}  // namespace isorelax::render
