#include "wavebalance/app/page/html.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"

namespace wavebalance::app {
namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(PageHtml, TextIsEscapedAndFormulasAreMarked) {
  EXPECT_EQ(escaped("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
  EXPECT_EQ(with_formulas("gap $g_0 < 1$ & more"), "gap <span class=\"math\">g_0 &lt; 1</span> &amp; more");
  EXPECT_EQ(with_formulas("costs 3 $"), "costs 3 $");
}

TEST(PageHtml, AFigureLinksItsPictureAndNamesItsCurves) {
  const std::string text = figure_html({"folder/fig", ".svg", "What \"it\" shows", "caption", true});
  EXPECT_TRUE(holds(text, "src=\"folder/fig.svg\""));
  EXPECT_TRUE(holds(text, "alt=\"What &quot;it&quot; shows\""));
  EXPECT_TRUE(holds(text, "data-curves=\"folder/fig.figure.js\""));
  EXPECT_FALSE(holds(figure_html({"fig", ".png", "words", "", false}), "data-curves"));
  EXPECT_THROW(figure_html({"fig", ".png", "", "", false}), std::invalid_argument);
}

TEST(PageHtml, PicturesTellTheirSizeBeforeTheyAreLoaded) {
  EXPECT_EQ(picture_size("<?xml?>\n<svg \n width=\"800\" height=\"540\"\n viewBox=\"0 0 800 540\">..."),
            " width=\"800\" height=\"540\"");
  const char png[] = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x06\x40\0\0\x03\x84";
  EXPECT_EQ(picture_size({png, sizeof png - 1}), " width=\"1600\" height=\"900\"");
  for (const char* other : {"", "text", "<svg viewBox=\"0 0 1 1\"><rect width=\"1\"/></svg>", "\x89PNG"})
    EXPECT_EQ(picture_size(other), "") << other;
}

TEST(PageHtml, TheFirstRowOfATableIsItsHead) {
  const std::string text = table_html({{"a", "b"}, {"1 | <2>", "$x$"}});
  EXPECT_TRUE(holds(text, "<thead><tr><th>a</th><th>b</th></tr>"));
  EXPECT_TRUE(holds(text, "<td>1 | &lt;2&gt;</td><td><span class=\"math\">x</span></td>"));
  EXPECT_EQ(table_html({}), "");
}

TEST(PageHtml, WithoutAFolderOfAssetsThePageHoldsThemItself) {
  PageParts page;
  page.title = "A & B";
  page.body = "<main></main>";
  page.libraries = {Library::d3};
  const std::string linked = page_html(page);
  EXPECT_TRUE(holds(linked, "<title>A &amp; B</title>"));
  EXPECT_TRUE(holds(linked, "href=\"assets/page.css\""));
  EXPECT_TRUE(holds(linked, "src=\"assets/curves.js\""));
  page.assets = "";
  const std::string whole = page_html(page);
  EXPECT_FALSE(holds(whole, "<script defer src"));
  EXPECT_FALSE(holds(whole, "<link"));
  EXPECT_TRUE(holds(whole, std::string(asset("curves.js"))));
  EXPECT_EQ(holds(whole, "d3js.org"), available(Library::d3));
}

TEST(PageAssets, AreWrittenWithTheLibrariesThatAreThere) {
  const TemporaryFolder folder;
  write_assets(folder.path(), {Library::d3, Library::katex});
  EXPECT_EQ(read_file(folder.path() / "page.css"), asset("page.css"));
  EXPECT_EQ(std::filesystem::exists(folder.path() / "d3.min.js"), available(Library::d3));
  EXPECT_EQ(std::filesystem::exists(folder.path() / "fonts/KaTeX_Main-Regular.woff2"),
            available(Library::katex));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "three.min.js"));
  EXPECT_THROW(asset("other.js"), std::out_of_range);
}

}  // namespace
}  // namespace wavebalance::app
