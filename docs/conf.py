"""Configuration of Sphinx. Paths of the build come from docs/make_site.cmake by -D."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "extension"))

project = "Wavebalance"
copyright = "the Wavebalance authors"
extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon", "wavebalance_docs"]
exclude_patterns = ["README.md"]
root_doc = "index"
language = "en"
smartquotes = False
highlight_language = "text"
pygments_style = "sphinx"
nitpicky = False
keep_warnings = False

templates_path = ["templates"]
html_theme = "basic"
html_static_path = ["static"]
html_css_files = ["katex/katex.min.css", "site.css"]
html_js_files = ["katex/katex.min.js", "site.js"]
html_math_renderer = "katex"
html_copy_source = False
html_show_sphinx = False
html_permalinks_icon = "#"
html_title = "Wavebalance"
html_domain_indices = False
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
napoleon_use_ivar = True
