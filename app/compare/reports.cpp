#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "compare/case.h"
#include "compare/embedded.h"
#include "compare/markup.h"

namespace isorelax::compare {
namespace {

std::string mark(const Case& one) {
  return one.passes() ? "<span class=\"mark pass\">passes</span>" : "<span class=\"mark fail\">fails</span>";
}

std::string cell(double value) {
  return "<td class=\"n\">" + escaped(number_text(value)) + "</td>";
}

std::string verdict_table(const std::vector<Verdict>& verdicts) {
  if (verdicts.empty()) return {};
  std::string html = "<table><tr><th>Limit</th><th>Found</th><th></th><th>Allowed</th><th></th></tr>\n";
  for (const Verdict& v : verdicts) {
    html += "<tr><td>" + escaped(v.meaning) + "</td>" + cell(v.found) + "<td>" +
            (v.at_least ? "at least" : "at most") + "</td>" + cell(v.limit);
    html += v.holds ? "<td class=\"holds\">holds</td>" : "<td class=\"broken\">broken</td>";
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

/// The figures that stand alone, then those that both sides have.
std::string figure_tables(const std::vector<Figure>& figures) {
  std::string alone, pairs;
  for (const Figure& f : figures) {
    std::string& rows = f.other ? pairs : alone;
    rows +=
        "<tr><td>" + escaped(f.label) + "</td>" + cell(f.value) + (f.other ? cell(*f.other) : "") + "</tr>\n";
  }
  if (!alone.empty()) alone = "<table>\n" + alone + "</table>\n";
  if (!pairs.empty()) pairs = "<table><tr><th></th><th>A</th><th>B</th></tr>\n" + pairs + "</table>\n";
  return alone + pairs;
}

std::string picture_grid(const std::vector<CasePicture>& pictures) {
  if (pictures.empty()) return {};
  std::string html = "<div class=\"pictures\">\n";
  for (const CasePicture& picture : pictures) {
    const std::string kind = picture.title == "A" ? "a" : picture.title == "B" ? "b" : "between";
    html += "<figure><figcaption>" + escaped(picture.title) + "</figcaption><img class=\"" + kind +
            "\" alt=\"" + escaped(picture.title) + "\" src=\"data:image/png;base64," + base64(picture.png) +
            "\"></figure>\n";
  }
  html += "</div>\n";
  if (pictures.size() > 1)
    html +=
        "<div class=\"stage\" hidden><div class=\"bar\"><button type=\"button\">Blink</button>"
        "<input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"Divider between A and B\">"
        "<output></output></div><div class=\"both\"></div></div>\n";
  return html;
}

std::string view_text(const char* title, const std::string& view) {
  if (view.empty()) return {};
  return std::string("<details><summary>") + title + "</summary><pre>" + escaped(view) + "</pre></details>\n";
}

std::string section(const Case& one, std::size_t number) {
  std::string html = "<section id=\"c" + std::to_string(number) + "\">\n<div class=\"head\">" + mark(one) +
                     "<h2>" + escaped(one.name) + "</h2></div>\n";
  html += "<p class=\"files\">A: " + escaped(one.a) + "<br>B: " + escaped(one.b) + "</p>\n";
  if (!one.failure.empty()) html += "<p class=\"failure\">" + escaped(one.failure) + "</p>\n";
  html += picture_grid(one.pictures) + verdict_table(one.verdicts);
  for (const std::string& note : one.notes) html += "<p class=\"note\">" + escaped(note) + "</p>\n";
  html += "<details open><summary>Figures</summary>" + figure_tables(one.figures) + "</details>\n";
  return html + view_text("View of A", one.view_a) + view_text("View of B", one.view_b) + "</section>\n";
}

std::string index_of(const std::vector<Case>& cases) {
  if (cases.size() < 2) return {};
  std::string html = "<table class=\"index\">\n";
  for (std::size_t i = 0; i < cases.size(); ++i)
    html += "<tr><td>" + mark(cases[i]) + "</td><td><a href=\"#c" + std::to_string(i) + "\">" +
            escaped(cases[i].name) + "</a></td><td>" + escaped(cases[i].failure) + "</td></tr>\n";
  return html + "</table>\n";
}

/// Why a case fails, in one line.
std::string reason(const Case& one) {
  if (!one.failure.empty()) return one.failure;
  std::string text;
  for (const Verdict& v : one.verdicts)
    if (!v.holds)
      text += (text.empty() ? "" : "; ") + v.meaning + " " + number_text(v.found) + ", allowed " +
              (v.at_least ? "at least " : "at most ") + number_text(v.limit);
  return text;
}

}  // namespace

std::string number_text(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "none" : value > 0 ? "infinite" : "-infinite";
  std::array<char, 40> text{};
  const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
  const int length = std::snprintf(text.data(), text.size(), whole ? "%.0f" : "%.6g", value);
  return {text.data(), static_cast<std::size_t>(std::max(0, length))};
}

std::string html_page(const std::string& title, const std::vector<Case>& cases) {
  const auto failed =
      static_cast<std::size_t>(std::ranges::count_if(cases, [](const Case& one) { return !one.passes(); }));
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
      escaped(title) + "</title>\n<style>\n" + std::string(embedded_file("report.css")) +
      "</style></head>\n<body>\n<h1>" + escaped(title) + "</h1>\n";
  html += "<p>" + std::to_string(cases.size() - failed) + " of " + std::to_string(cases.size()) +
          (cases.size() == 1 ? " comparison passes.</p>\n" : " comparisons pass.</p>\n");
  html += index_of(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) html += section(cases[i], i);
  return html + "<script>\n" + std::string(embedded_file("report.js")) + "</script>\n</body></html>\n";
}

std::string junit_xml(const std::vector<Case>& cases) {
  const auto failed = std::ranges::count_if(cases, [](const Case& one) { return !one.passes(); });
  const std::string counts =
      " tests=\"" + std::to_string(cases.size()) + "\" failures=\"" + std::to_string(failed) + "\"";
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + counts + ">\n";
  xml += "<testsuite name=\"isorelax compare\"" + counts + " errors=\"0\" skipped=\"0\">\n";
  for (const Case& one : cases) {
    xml += "  <testcase classname=\"isorelax.compare\" name=\"" + escaped(one.name) + "\"";
    if (one.passes())
      xml += "/>\n";
    else
      xml += "><failure message=\"" + escaped(reason(one)) + "\"/></testcase>\n";
  }
  return xml + "</testsuite>\n</testsuites>\n";
}

}  // namespace isorelax::compare
