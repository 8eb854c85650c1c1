"""Pieces of a page of benchmarks in Markdown."""


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|---" + "|--:" * (len(header) - 1) + "|"]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n\n"


def number(value):
    if value is None:
        return ""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"


def folded(title, text):
    return f"<details><summary>{title}</summary>\n\n{text}</details>\n\n"


def picture(drawn, name, title):
    return f"![{title}](images/{name})\n\n" if drawn else ""
