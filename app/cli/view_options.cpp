#include "cli/view_options.h"

#include <CLI/App.hpp>
#include <cmath>
#include <filesystem>
#include <utility>

#include "mesh/error.h"
#include "render/picture_size.h"
#include "view/picture.h"

namespace isorelax::cli {
namespace {

using view::View;

double parse_number(const std::string& option, const std::string& text) {
  double value = 0;
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value))
    throw UsageError(option + " " + text + ": is no number");
  return value;
}

render::Background read_background(const std::string& text) {
  try {
    return render::parse_background(text);
  } catch (const UsageError& error) {
    throw UsageError(std::string(error.what()) + ", or transparent");
  }
}

/// Whether --camera names a file and not a direction.
bool is_view_file(const std::string& text) {
  const std::string extension = std::filesystem::path(text).extension().string();
  return extension == ".json" || extension == ".png";
}

}  // namespace

void ViewOptions::text(CLI::App& app, const std::string& name, const char* kind, const std::string& help,
                       std::function<Change(const std::string&)> change) {
  app.add_option_function<std::string>(
         name,
         [this, change = std::move(change)](const std::string& given) { changes_.push_back(change(given)); },
         help)
      ->type_name(kind);
}

void ViewOptions::flag(CLI::App& app, const std::string& name, const std::string& help, bool View::*member) {
  app.add_flag_function(
      "--" + name + ",!--no-" + name,
      [this, member](std::int64_t count) {
        changes_.emplace_back([member, on = count > 0](View& view) { view.*member = on; });
      },
      help);
}

void ViewOptions::declare_colors(CLI::App& app) {
  text(app, "--color", "C", "angle (smallest, default), max-angle, area, energy, class (features) or none",
       [](const std::string& given) -> Change {
         return [color = view::parse_color(given)](View& view) {
           // Ends that were chosen for another quantity mean nothing for this one.
           if (color != view.color) view.range = {};
           view.color = color;
         };
       });
  text(
      app, "--range", "LO:HI|run|current",
      "Ends of the colour map: two values, the quantity's own over all meshes (run, default), or those found",
      [](const std::string& given) -> Change {
        return [range = view::parse_range_choice(given)](View& view) { view.range = range; };
      });
  text(app, "--colormap", "MAP", "viridis, cividis, inferno, magma or blue-orange",
       [](const std::string& given) -> Change {
         return [map = render::parse_color_map(given)](View& view) { view.color_map = map; };
       });
  flag(app, "reverse", "Turn the colour map round", &View::reversed);
  text(app, "--only-worse-than", "V",
       "Draw only triangles worse than this: angles below V, largest angles and energies above, areas off "
       "the mean "
       "by more than V times; with --difference those that got worse by more than V",
       [](const std::string& given) -> Change {
         return
             [limit = parse_number("--only-worse-than", given)](View& view) { view.only_worse_than = limit; };
       });
  text(app, "--against", "FILE", "Mesh of the same triangles that differences and arrows start from",
       [](const std::string& given) -> Change { return [given](View& view) { view.against = given; }; });
  flag(app, "difference", "Colour by change since --against, on a diverging map", &View::difference);
  flag(app, "arrows", "Draw an arrow from where each vertex was in --against to where it is", &View::arrows);
  text(app, "--arrow-scale", "S", "Draw the arrows S times as long (default 1)",
       [](const std::string& given) -> Change {
         return [scale = parse_number("--arrow-scale", given)](View& view) { view.arrow_scale = scale; };
       });
}

void ViewOptions::declare_drawing(CLI::App& app) {
  text(app, "--shading", "S", "flat (default) or smooth", [](const std::string& given) -> Change {
    if (given != "flat" && given != "smooth")
      throw UsageError("--shading " + given + ": expected flat or smooth");
    return [given](View& view) {
      view.shading = given == "smooth" ? render::Shading::smooth : render::Shading::flat;
    };
  });
  flag(app, "wire", "Draw the edges", &View::wire);
  flag(app, "boundary-edges", "Mark the edges with one triangle", &View::boundary);
  text(app, "--legend", "on|off", "on (default) or off", [](const std::string& given) -> Change {
    if (given != "on" && given != "off") throw UsageError("--legend " + given + ": expected on or off");
    return [given](View& view) { view.legend = given == "on"; };
  });
  flag(app, "numbers", "Write figures of the quality report into the picture", &View::numbers);
  app.add_option_function<std::vector<std::string>>(
         "--label",
         [this](const std::vector<std::string>& labels) {
           changes_.emplace_back([labels](View& view) { view.labels = labels; });
         },
         "Text at the lower left, one for each mesh (default: file names where there are several)")
      ->type_name("TEXT")
      ->expected(1)
      ->take_all();
  text(app, "--background", "B", "dark (default), light, white, black, #rrggbb, r,g,b or transparent",
       [](const std::string& given) -> Change {
         if (given == "transparent") return [](View& view) { view.transparent = true; };
         return [background = read_background(given)](View& view) {
           view.background = background;
           view.transparent = false;
         };
       });
  text(app, "--supersampling", "N", "Draw N times larger and average: 1 (default) to 4",
       [](const std::string& given) -> Change {
         if (given.size() != 1 || given[0] < '1' || given[0] > '4')
           throw UsageError("--supersampling " + given + ": expected 1, 2, 3 or 4");
         return [times = given[0] - '0'](View& view) { view.supersampling = times; };
       });
}

void ViewOptions::declare_camera(CLI::App& app) {
  app.add_option_function<std::string>(
         "--camera",
         [this](const std::string& given) {
           if (is_view_file(given))
             source_ = given;
           else
             changes_.emplace_back([given](View& view) { view.camera = given; });
         },
         "Where from (default fit), or a saved view: its camera, colours, size and all else")
      ->type_name("SPEC|FILE.json");
  text(app, "--projection", "P", "perspective or orthographic", [](const std::string& given) -> Change {
    if (given != "perspective" && given != "orthographic")
      throw UsageError("--projection " + given + ": expected perspective or orthographic");
    return [given](View& view) {
      if (auto* camera = std::get_if<render::Camera>(&view.camera))
        camera->projection =
            given == "perspective" ? render::Projection::perspective : render::Projection::orthographic;
      else
        std::get<std::string>(view.camera) += ":" + given;
    };
  });
  app.add_option("--like", source_, "Draw as this picture of isorelax was drawn")->type_name("PICTURE.png");
  app.add_option_function<std::string>(
         "--context", [this](const std::string& given) { context_ = render::parse_context_kind(given); },
         "osmesa (default) or egl")
      ->type_name("C");
}

void ViewOptions::declare(CLI::App& app) {
  text(app, "--size", "WxH",
       "Picture size in pixels (default 1280x720): sides up to 16384, no more than 8192x8192 in all",
       [](const std::string& given) -> Change {
         return [size = render::parse_size(given)](View& view) { view.size = size; };
       });
  declare_colors(app);
  declare_camera(app);
  declare_drawing(app);
}

view::View ViewOptions::read() const {
  View view;
  if (!source_.empty()) view = view::read_view(source_);
  for (const Change& change : changes_) change(view);
  return view;
}

}  // namespace isorelax::cli
