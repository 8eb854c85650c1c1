# The manual: Sphinx over the pages as they lie in the tree, so that links between pages work here and on a forge.
# scripts/build_site builds it.
import re
from pathlib import Path

from pygments.lexers.special import TextLexer

project = "Glissade"
copyright = "the Glissade authors, BSD 3-Clause licence"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
include_patterns = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/*.md", "docs/tutorials/*.md",
                    "docs/coming_from/*.md", "docs/site/*.rst"]
root_doc = "docs/site/index"
nitpicky = True
highlight_language = "none"  # of blocks that name none: what programs print
# Types of NumPy and of arguments that stubs describe are no pages of this manual.
nitpick_ignore_regex = [("py:.*", r"(numpy|array|object|list|tuple|bool|int|float|str|None|List|Optional|Tuple|Callable).*")]

myst_heading_anchors = 4
myst_enable_extensions = ["dollarmath"]

html_theme = "furo"
html_title = "Glissade"
html_static_path = ["static"]
html_extra_path = ["top"]
html_css_files = ["manual.css"]
html_copy_source = False
html_show_sphinx = False
html_show_search_summary = False  # it would need a server


def make_self_contained(app, error):
    """Debian's Furo needs a server: its style sheet is at the root of one, and its script imports another. A browser
    loads neither from a file."""
    if error:
        return
    static = Path(app.outdir) / "_static"
    styles = static / "styles/furo.css"
    normalize = Path("/usr/share/javascript/normalize.css/normalize.css").read_text()
    rules = styles.read_text().replace("@import url(/javascript/normalize.css/normalize.css);", "")
    # Its style sheet is dark at a click only, because Debian's compiler drops rules inside two conditions.
    dark = re.search(r'body\[data-theme="dark"\] \{(.*?)\}', rules, re.DOTALL)[1]
    rules += f'@media screen and (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {{{dark}}} }}\n'
    styles.write_text(normalize + rules)
    script = static / "scripts/furo.js"
    menu = (static / "scripts/gumshoe-patched.js").read_text()
    script.write_text(menu + script.read_text().replace('import Gumshoe from "./gumshoe-patched.js";', ""))


def setup(app):
    app.add_lexer("csv", TextLexer)  # Pygments has none
    app.connect("build-finished", make_self_contained)
