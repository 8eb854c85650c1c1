"""A few lines of SVG for the figures of docs/sliding.md: plain shapes, one style for light and dark screens."""

import pathlib
import re

PALETTE = pathlib.Path(__file__).parent.parent / "viewer/page/src/palette.css"
SHAPES = """
text { font: 13px sans-serif; }
text.quiet { font-size: 12px; }
text.title { font-weight: bold; font-size: 14px; }
.line, .thin, .part, .ghost, .force, .good, .box { fill: none; }
.solid { stroke-width: 1.5; } .line { stroke-width: 1.2; } .thin { stroke-width: 0.8; } .box { stroke-width: 1.4; }
.part, .force, .good { stroke-width: 2; } .ghost { stroke-width: 1.8; stroke-dasharray: 6 4; }
.dashed { stroke-dasharray: 5 4; }
.allowed { fill-opacity: 0.14; }
.dot, .head { stroke: none; }
"""


def colors(palette):
    """The rules that differ between light and dark, without CSS variables, which some viewers do not support."""
    rules = ".page { fill: %(card)s; } text, .dot { fill: %(text)s; } text.quiet { fill: %(quiet)s; }\n"
    rules += ".solid { fill: %(grid)s; stroke: %(quiet)s; } .line, .box { stroke: %(quiet)s; } .head { fill: %(quiet)s; }\n"
    rules += ".thin { stroke: %(quiet)s; } .allowed { fill: %(c2)s; }\n"
    for kind, color in {"part": "c0", "ghost": "c1", "force": "c4", "good": "c2"}.items():
        rules += f".{kind} {{ stroke: %({color})s; }} .dot.{kind}, .head.{kind} {{ fill: %({color})s; stroke: none; }}\n"
    return rules % dict(re.findall(r"--(\w+): (#\w+);", palette))


LIGHT, DARK = PALETTE.read_text(encoding="utf-8").split("@media (prefers-color-scheme: dark)")
STYLE = SHAPES + colors(LIGHT) + "@media (prefers-color-scheme: dark) {\n" + colors(DARK) + "}\n"


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def number(value):
    return f"{value:.2f}".rstrip("0").rstrip(".")


class Drawing:
    """A picture of `width` by `height` pixels, y downwards."""

    def __init__(self, width, height, title):
        self.size = (width, height)
        self.title = title
        self.parts = []

    def polygon(self, points, kind):
        self.parts.append(f'<polygon class="{kind}" points="{" ".join(f"{number(x)},{number(y)}" for x, y in points)}"/>')

    def curve(self, points, kind):
        self.parts.append(f'<polyline class="{kind}" points="{" ".join(f"{number(x)},{number(y)}" for x, y in points)}"/>')

    def line(self, a, b, kind="line"):
        self.curve([a, b], kind)

    def circle(self, center, radius, kind):
        self.parts.append(f'<circle class="{kind}" cx="{number(center[0])}" cy="{number(center[1])}" r="{number(radius)}"/>')

    def box(self, x, y, width, height, kind="box"):
        self.parts.append(f'<rect class="{kind}" x="{number(x)}" y="{number(y)}" width="{number(width)}" '
                          f'height="{number(height)}" rx="7"/>')

    def text(self, x, y, lines, kind="", anchor="start"):
        for i, line in enumerate([lines] if isinstance(lines, str) else lines):
            self.parts.append(f'<text class="{kind}" x="{number(x)}" y="{number(y + 17 * i)}" '
                              f'text-anchor="{anchor}">{escaped(line)}</text>')

    def arrow(self, *points, kind="", dashed=False):
        """A polyline with a head at its last point."""
        (x0, y0), (x1, y1) = points[-2], points[-1]
        length = ((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5
        ux, uy = (x1 - x0) / length, (y1 - y0) / length
        neck = (x1 - 8 * ux, y1 - 8 * uy)
        self.curve([*points[:-1], neck], (kind or "line") + (" dashed" if dashed else ""))
        side = [(neck[0] - 4 * uy, neck[1] + 4 * ux), (neck[0] + 4 * uy, neck[1] - 4 * ux)]
        self.polygon([(x1, y1), *side], f"head {kind}".strip())

    def save(self, path):
        width, height = self.size
        body = "\n".join(self.parts)
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
                        f'height="{height}" role="img" aria-label="{escaped(self.title)}">\n<style>{STYLE}</style>\n'
                        f'<rect class="page" width="{width}" height="{height}"/>\n{body}\n</svg>\n', encoding="utf-8")
