#!/usr/bin/env python3
"""Renews the generated parts of a page of benchmarks: bench_report.py RESULTS.csv PAGE.md --command TEXT.

A generated part stands between <!-- begin NAME --> and <!-- end NAME -->. Only those of benches that have rows in the
results are replaced; everything else is written by hand. Plots go to the folder `images` beside the page.
"""

import argparse
import datetime
import pathlib
import re
import subprocess
import sys

import bench_plots
from bench_figures import HULL_PEERS, PART_PEERS, PEERS, PEER_TITLES, geometric_mean, read_results
from bench_haptics_tables import ages, clasp, handoff, latency, led, passivity, sliding, tick
from bench_tables import table, number, folded, picture

PHASES = ["gap-1%", "gap-0.5%", "gap-0.1%", "touching", "colliding"]


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()


def machine(command, bench):
    cpu = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text())
    packages = {PEER_TITLES[peer]: peer for peer in PEERS}
    if bench == "hull":
        packages = {"libccd": "ccd", "FCL": "fcl", "Bullet": "bullet"}
    elif bench == "parts":
        packages = {"FCL": "fcl"}
    elif bench == "handoff":
        packages = {"Boost": "boost"}
    elif bench in ("sliding", "led", "tick", "passivity", "ages", "clasp", "latency"):
        packages = {}
    versions = [f"{title} {output_of('dpkg-query', '-W', '-f=${Version}', f'lib{package}-dev')}" for title, package in packages.items()]
    facts = [datetime.date.today().isoformat(), cpu[1] if cpu else "unknown processor", output_of("c++", "--version").splitlines()[0]]
    if versions:
        facts.append("Debian's " + ", ".join(versions))
    return f"*{'; '.join(facts)}; `{command}`*\n\n"


def ratio_table(figures):
    """The ratio to each peer: geometric mean, worst."""
    peers = [peer for peer in PEERS if figures.get("geomean", "glissade", "ratio_to_" + peer) is not None]
    header = ["times faster than (geometric mean, worst case)"] + [PEER_TITLES[peer] for peer in peers]
    rows = []
    for subject in figures.variants():
        cells = []
        for peer in peers:
            mean = figures.get("geomean", subject, "ratio_to_" + peer)
            worst = figures.get("worst", subject, "ratio_to_" + peer)
            cells.append("" if mean is None else f"{mean:.1f}, {worst:.1f}")
        if any(cells):
            rows.append([subject] + cells)
    return table(header, rows)


def disagreements(figures):
    found = []
    for subject in figures.subjects:
        count = figures.count_disagreements(subject)
        if count is not None and (count > 0 or subject in PEER_TITLES):
            found.append(f"{subject} {count:.0f}")
    return "Answers that differ from Glissade's: " + ", ".join(found) + ".\n\n" if found else ""


def time_table(figures, subjects, metric="time", unit="µs", scale=1e-3):
    """One row for each case."""
    present = [who for who in subjects if any(figures.get(case, who, metric) is not None for case in figures.cases)]
    rows = []
    for case in figures.cases:
        values = [figures.get(case, who, metric) for who in present]
        if any(value is not None for value in values):
            rows.append([case] + [number(None if value is None else scale * value) for value in values])
    return table([unit] + present, rows)


def query_tables(figures):
    """The end of the section of every bench of queries."""
    text = disagreements(figures)
    main = ["glissade", "glissade-coherent", "fcl"]
    text += folded("Mean time of a query, µs", time_table(figures, main))
    slow = time_table(figures, ["glissade", "ode", "bullet", "cgal"], "time_sample")
    if "ode" in figures.subjects:
        text += folded("Mean time of a query on the sample that the slower libraries take, µs", slow)
    work = [[case] + [number(figures.get(case, "glissade", what)) for what in ("node_tests", "realignments", "triangle_tests")]
            for case in figures.cases if figures.get(case, "glissade", "node_tests") is not None]
    return text + folded("Work of a query of Glissade, means", table(["", "node tests", "realignments", "triangle tests"], work))


def zachmann(figures, images):
    text = ratio_table(figures)
    text += picture(bench_plots.draw_growth(images / "bench_zachmann.svg", figures), "bench_zachmann.svg",
                    "Time of a query against the number of triangles, Glissade and FCL")
    text += picture(bench_plots.draw_figure_3(images / "bench_figure3.svg", figures), "bench_figure3.svg",
                    "Figure 3 of the paper today: pure DOP-trees and OBB-trees")
    text += picture(bench_plots.draw_directions(images / "bench_directions.svg", figures), "bench_directions.svg",
                    "Time of a query against the number of directions")
    far = figures.get("far-spheres", "glissade", "time")
    if far is not None:
        text += f"A pair of spheres three radii apart takes {far / 1000:.2g} µs"
        fcl = figures.get("far-spheres", "fcl", "time")
        text += f" (FCL: {fcl / 1000:.2g} µs).\n"
    growth = figures.get("growth", "glissade", "time_1M_by_1k")
    if growth is not None:
        text += f"From 1,000 to 1,000,000 triangles the time grows {growth:.2g} times (geometric mean over the shapes).\n"
    return text + "\n" + query_tables(figures)


def queries(figures, _):
    return ratio_table(figures) + query_tables(figures)


def coherent(figures, images):
    text = ratio_table(figures)
    text += picture(bench_plots.draw_coherent(images / "bench_coherent.svg", figures, PHASES), "bench_coherent.svg",
                    "Time of a query while sliding, by gap")
    return text + query_tables(figures)


def all_pairs(figures, _):
    pairs = time_table(figures, ["glissade", "fcl"], "pairs", "pairs a query", 1)
    per_pair = time_table(figures, ["glissade", "fcl"], "time_per_pair", "ns a pair", 1)
    return ratio_table(figures) + query_tables(figures) + folded("Pairs", pairs) + folded("Time a pair", per_pair)


PART_QUESTIONS = {"yes-no": "yes or no, Zachmann's procedure", "yes-no-0.1%": "yes or no, 0.1 % apart", "yes-no-1%": "yes or no, 1 % apart",
                  "all-pairs": "all pairs", "distance-0.1%": "distance, 0.1 % apart", "distance-1%": "distance, 1 % apart",
                  "distance-10%": "distance, 10 % apart", "distance-coherent": "distance while sliding, coherent"}


def part_ratios(figures, peer):
    """How many times faster than the peer, by question and then by part."""
    ratios = {}
    for case in figures.measured_cases():
        question, part = case.split(" ", 1)
        who = "glissade-coherent" if question == "distance-coherent" else "glissade"
        theirs = figures.get(case, peer, "time")
        if theirs is not None:
            ratios.setdefault(question, {})[part] = theirs / figures.get(case, who, "time")
    return ratios


def parts(figures, _):
    """Ratios to each peer by question, with the worst parts by name, then of each part."""
    ratios = {peer: part_ratios(figures, peer) for peer in PART_PEERS}
    ratios = {peer: of_question for peer, of_question in ratios.items() if of_question}
    questions = [question for question in PART_QUESTIONS if any(question in of_question for of_question in ratios.values())]
    rows = []
    for question in questions:
        cells = []
        for of_question in ratios.values():
            of_part = of_question.get(question, {})
            if not of_part:
                cells += ["", ""]
                continue
            worst = sorted(of_part, key=of_part.get)[:2]
            cells += [f"{geometric_mean(of_part.values()):.1f}", ", ".join(f"{of_part[part]:.2g} {part}" for part in worst)]
        parts_of_question = {part for of_question in ratios.values() for part in of_question.get(question, {})}
        rows.append([PART_QUESTIONS[question], str(len(parts_of_question))] + cells)
    header = ["times faster than", "parts and pairs"]
    for peer in ratios:
        header += [f"{PEER_TITLES[peer]}: geometric mean", "worst"]
    text = table(header, rows) + disagreements(figures)
    names = list(dict.fromkeys(case.split(" ", 1)[1] for case in figures.measured_cases()))
    cells = [[part] + [" / ".join(number(of_question.get(question, {}).get(part)) for of_question in ratios.values()) for question in questions]
             for part in names]
    title = "Times faster than " + " / ".join(PEER_TITLES[peer] for peer in ratios) + ", of each part"
    return text + folded(title, table(["two copies, or two parts"] + questions, cells))


def build(figures, images):
    subjects = ["glissade", "glissade-one-thread"] + PEERS
    text = ratio_table(figures)
    text += picture(bench_plots.draw_build(images / "bench_build.svg", figures), "bench_build.svg", "Time to build")
    text += folded("Time to build, ms", time_table(figures, subjects, "time", "ms", 1e-6))
    return text + folded("Bytes a triangle", time_table(figures, subjects, "bytes_per_triangle", "B", 1))


def hull(figures, images):
    header = ["times faster than (geometric mean, worst case)"] + [PEER_TITLES[peer] for peer in HULL_PEERS]
    rows = []
    for group in ["separated", "touching", "penetrating", ""]:
        prefix = group + "-" if group else ""
        cells = []
        for peer in HULL_PEERS:
            mean = figures.get(prefix + "geomean", "glissade", "ratio_to_" + peer)
            worst = figures.get(prefix + "worst", "glissade", "ratio_to_" + peer)
            cells.append("" if mean is None else f"{mean:.1f}, {worst:.1f}")
        rows.append([f"{group}, 0.05 degrees a step" if group else "all gaps and steps"] + cells)
    text = table(header, rows)
    text += picture(bench_plots.draw_figure_4(images / "bench_hull.svg", figures), "bench_hull.svg",
                    "Figure 4 of the paper today: time of a query against distance, number of corners and rotational velocity")
    wrong = {subject: sum(figures.get(case, subject, "wrong") or 0 for case in figures.cases) for subject in figures.subjects}
    text += "Wrong answers: " + ", ".join(f"{subject} {count:.0f}" for subject, count in wrong.items()) + ".\n\n"
    subjects = ["glissade", "glissade-perceptron"] + HULL_PEERS
    return text + folded("Mean time of a query, ns", time_table(figures, subjects, "time", "ns", 1))


STAGES = ["queue", "neighbor_finding", "separating_planes", "exact"]


def stage_table(figures):
    """Pairs that enter and leave each stage of the pipeline, and its time."""
    rows = []
    for case in figures.cases:
        if figures.get(case, "glissade", "exact_us") is None:
            continue
        cells = [number(figures.get(case, "glissade", "neighbors"))]
        for stage in STAGES:
            passed, us = (figures.get(case, "glissade", f"{stage}_{what}") for what in ("out", "us"))
            cells.append(f"{number(passed)}, {number(us)} µs")
        rows.append([case] + cells)
    return table(["passed on, time", "boxes overlap"] + [stage.replace("_", " ") for stage in STAGES], rows)


def means_table(figures):
    """Mean and 99th percentile of the frames, and the factor over the fastest peer: medians hide slow frames."""
    subjects = [who for who in ["glissade"] + PEERS if who in figures.subjects]
    rows = []
    for case in figures.cases:
        if figures.get(case, "glissade", "us_per_frame_mean") is None:
            continue
        cells = []
        for who in subjects:
            mean, slow = (figures.get(case, who, "us_per_frame_" + what) for what in ("mean", "p99"))
            cells.append("" if mean is None else f"{number(mean)}, {number(slow)}")
        cells += [number(figures.get(case, "glissade", prefix + "ratio_to_best_peer")) for prefix in ("mean_", "")]
        rows.append([case] + cells)
    if not rows:
        return ""
    text = "Means and 99th percentiles (below a hundred frames: the slowest frame), and the factor over the best peer:\n\n"
    return text + table(["µs a frame: mean, 99th percentile"] + subjects + ["times faster, by means", "by medians"], rows)


def scene(figures, images):
    text = ratio_table(figures)
    text += picture(bench_plots.draw_scene(images / "bench_scene.svg", figures), "bench_scene.svg",
                    "Figure 5 of the paper today: time of a frame against the number of objects")
    text += time_table(figures, ["glissade"] + PEERS, "us_per_frame", "µs a frame", 1)
    text += means_table(figures)
    shares = [figures.get(case, "machine", "cpu_share") for case in figures.cases]
    text += (f"The program had a processor for at least {min(filter(None, shares)):.0%} of the time. Well below 100 %, slow "
             "libraries look slower than they are.\n\n")
    ratio = figures.get("rest-1000", "glissade", "time_by_rest-10")
    if ratio is not None:
        text += f"One moving object among 1,000 resting ones takes {ratio:.2f} times as long as among 10, with the same neighbors.\n\n"
    text += disagreements(figures).replace("Answers that differ", "Pairs of all frames that differ")
    text += folded("Frames that were timed", time_table(figures, ["glissade"] + PEERS, "frames", "frames", 1))
    return text + folded("The stages of Glissade's pipeline", stage_table(figures))


def threads(figures, _):
    subjects = [who for who in figures.variants() if any(figures.get(case, who, "speedup") for case in figures.cases)]
    rows = []
    for case in figures.cases:
        metric = "us_per_frame" if figures.get(case, "glissade", "us_per_frame") is not None else "us_all_queries"
        cells = [number(figures.get(case, "glissade", metric))]
        for who in subjects:
            cells.append(f"{number(figures.get(case, who, metric))} ({figures.get(case, who, 'speedup'):.2f} times faster)")
        rows.append([case] + cells)
    header = ["µs", "1 thread"] + [who.removeprefix("glissade-").replace("-", " ") for who in subjects]
    return table(header, rows) + disagreements(figures)


SECTIONS = {"zachmann": zachmann, "close": queries, "shells": queries, "coherent": coherent, "all-pairs": all_pairs, "parts": parts,
            "build": build, "hull": hull, "scene": scene, "threads": threads, "sliding": sliding, "led": led, "tick": tick, "passivity": passivity, "ages": ages, "clasp": clasp,
            "handoff": handoff, "latency": latency}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--command", required=True, help="the command that produced the results")
    arguments = parser.parse_args()

    text = arguments.page.read_text()
    images = arguments.page.parent / "images"
    images.mkdir(exist_ok=True)
    for bench, figures in read_results(arguments.results).items():
        begin, end = f"<!-- begin {bench} -->", f"<!-- end {bench} -->"
        if begin not in text or end not in text:
            sys.exit(f"{arguments.page}: the markers of {bench} are missing")
        body = machine(arguments.command, bench) + SECTIONS[bench](figures, images)
        text = text[:text.index(begin)] + f"{begin}\n{body.rstrip()}\n" + text[text.index(end):]
    arguments.page.write_text(text)


if __name__ == "__main__":
    main()
