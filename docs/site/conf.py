# The manual: Sphinx over the pages as they lie in the tree, so that links between pages work here and on a forge.
# scripts/build_site builds it.
import ast
import re
from pathlib import Path

import glissade
from pygments.lexers.special import TextLexer

project = "Glissade"
copyright = "the Glissade authors, BSD 3-Clause licence"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
include_patterns = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/*.md", "docs/tutorials/*.md",
                    "docs/coming_from/*.md", "docs/site/*.rst"]
root_doc = "docs/site/index"
nitpicky = True
highlight_language = "none"  # of blocks that name none: what programs print
# Types of Python and of NumPy are no pages of this manual.
nitpick_ignore_regex = [("py:.*", r"(numpy|np\.|NDArray|ArrayLike|PathLike|Any|Sequence|TracebackType|BaseException|"
                         r"object|list|tuple|dict|type|bool|int|float|str|bytes|None|Optional|Tuple|List).*")]
autoclass_content = "both"  # also of __init__
# The values of tuples of names, as |JOINT_NAMES|.
rst_epilog = "\n".join(f".. |{name}| replace:: " + ", ".join(f"``{value}``" for value in getattr(glissade, name))
                       for name in ["JOINT_NAMES", "SLIDING_STATES", "LIMIT_REASONS", "GLOVE_PRESETS"])

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


def read_stubs():
    """The functions and attributes in the stubs of the module, by their full names, and the abbreviations of types."""
    stubs, types = {}, {}
    for node in ast.parse((Path(__file__).parents[2] / "python/glissade/__init__.pyi").read_text()).body:
        if isinstance(node, ast.Assign):
            types[node.targets[0].id] = ast.unparse(node.value)
        if isinstance(node, ast.FunctionDef):
            stubs[f"glissade.{node.name}"] = node
        for each in node.body if isinstance(node, ast.ClassDef) else []:
            name = each.name if isinstance(each, ast.FunctionDef) else ast.unparse(getattr(each, "target", each))
            stubs.setdefault(f"glissade.{node.name}.{name}", each)  # the getter of a property, not its setter
    return stubs, types


STUBS, TYPES = read_stubs()


def with_types_of_stubs(app, what, name, thing, options, signature, result):
    """Arguments and results as the stubs describe them. The module itself says `object` for an array or a path."""
    stub = STUBS.get(f"{name}.__init__" if what == "class" else name)
    if stub is None:
        return None
    if isinstance(stub, ast.AnnAssign):
        return "()", ast.unparse(stub.annotation)
    stub.args.args = [argument for argument in stub.args.args if argument.arg != "self"]
    texts = [f"({ast.unparse(stub.args)})", ast.unparse(stub.returns)]
    for short, full in TYPES.items():
        texts = [re.sub(rf"\b{short}\b", full, text) for text in texts]
    return texts[0], None if what == "class" else texts[1]


def mark_settable(app, what, name, thing, options, lines):
    if what == "property" and thing.fset:
        lines.extend(["", "Can be set."])


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
    app.connect("autodoc-process-signature", with_types_of_stubs)
    app.connect("autodoc-process-docstring", mark_settable)
    app.connect("build-finished", make_self_contained)
