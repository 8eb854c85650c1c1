#!/usr/bin/env python3
"""scripts/check_snippets finds each kind of broken block: check_snippets_test.py BUILD_DIR."""
import pathlib
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/check_snippets"

THIS = "tests/architecture/check_snippets_test.py"
COMMAND = " ".join(["make", "nothing"])  # does not stand in this file

# The text of a page, and what the script says of it.
BROKEN = {
    "```cpp\nint broken();\n```": "page.md:3: no file of examples/ has these lines",
    "```sh\nglissade slide nothing.yaml --part a --trajectory b.csv\n```": "nothing.yaml: there is no such file",
    "```python\nimport glissade\nglissade.distances\n```": "has no attribute 'distances'",
    "`x.yaml`:\n\n```yaml\nobjects: [{nme: a}]\n```\n\n```sh\nglissade slide x.yaml --part a --trajectory poses.csv\n```":
        "unknown key 'nme'",
    "```yaml\nobjects: []\n```": "no line before the block begins with the name of its file",
    "`x.yaml`:\n\n```yaml\nobjects: []\n```": "no other block uses x.yaml",
    "Text.\n\n<!-- run by scripts/lint -->\n```cmake\nx\n```": "page.md:6: scripts/lint does not name page.md",
    f"Text.\n\n<!-- run by {THIS} -->\n```sh\ngit\nsudo ./{COMMAND}  # which is not run\n```":
        f"page.md:6: {THIS} does not run `sudo ./{COMMAND}`",
    "```sh\necho 1; echo 25\n```\n\n```\n1\n2\n```": "page.md:7: the commands before it print otherwise:\n1\n25",
    "Text.\n\n<!-- not run -->\n```sh\nx\n```": "page.md:5: no such mark: <!-- not run -->",
    "```rust\nx\n```": "blocks of 'rust' need a comment",
    "Text.\n\n<!-- terminals -->\n```sh\nglissade run square_peg.yaml\nglissade run nothing.yaml\n```": "exit code 2",
}


def main() -> int:
    wrong = 0
    for text, expected in BROKEN.items():
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            page.write_text(f"# Page\n\n{text}\n")
            done = subprocess.run([SCRIPT, sys.argv[1], page], capture_output=True, text=True)
            if done.returncode == 77:
                return 77
            if done.returncode != 1 or expected not in done.stderr:
                print(f"{text}\nshould give: {expected}\ngave {done.returncode}: {done.stderr}", file=sys.stderr)
                wrong += 1
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
