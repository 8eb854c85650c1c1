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
from bench_figures import HULL_PEERS, PEERS, PEER_TITLES, geometric_mean, read_results

PHASES = ["gap-1%", "gap-0.5%", "gap-0.1%", "touching", "colliding"]


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()


def machine(command, bench):
    cpu = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text())
    packages = {PEER_TITLES[peer]: peer for peer in PEERS}
    if bench == "hull":
        packages = {"libccd": "ccd", "FCL": "fcl", "Bullet": "bullet"}
    elif bench == "handoff":
        packages = {"Boost": "boost"}
    elif bench in ("sliding", "tick", "passivity", "ages", "clasp", "latency"):
        packages = {}
    versions = [f"{title} {output_of('dpkg-query', '-W', '-f=${Version}', f'lib{package}-dev')}" for title, package in packages.items()]
    facts = [datetime.date.today().isoformat(), cpu[1] if cpu else "unknown processor", output_of("c++", "--version").splitlines()[0]]
    if versions:
        facts.append("Debian's " + ", ".join(versions))
    return f"*{'; '.join(facts)}; `{command}`*\n\n"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|---" + "|--:" * (len(header) - 1) + "|"]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n\n"


def number(value):
    if value is None:
        return ""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"


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
        if count is not None and (count > 0 or subject in PEERS):
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


def folded(title, text):
    return f"<details><summary>{title}</summary>\n\n{text}</details>\n\n"


def picture(drawn, name, title):
    return f"![{title}](images/{name})\n\n" if drawn else ""


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


def parts(figures, _):
    """Ratios to FCL by question, with the worst parts by name, then of each part."""
    ratios = {question: {} for question in PART_QUESTIONS}
    for case in figures.measured_cases():
        question, part = case.split(" ", 1)
        who = "glissade-coherent" if question == "distance-coherent" else "glissade"
        ratios[question][part] = figures.get(case, "fcl", "time") / figures.get(case, who, "time")
    rows = []
    for question, of_part in ratios.items():
        if of_part:
            worst = sorted(of_part, key=of_part.get)[:3]
            rows.append([PART_QUESTIONS[question], str(len(of_part)), f"{geometric_mean(of_part.values()):.1f}",
                         ", ".join(f"{of_part[part]:.2g} {part}" for part in worst)])
    text = table(["times faster than FCL", "parts and pairs", "geometric mean", "worst"], rows) + disagreements(figures)
    ratios = {question: of_part for question, of_part in ratios.items() if of_part}
    names = list(dict.fromkeys(case.split(" ", 1)[1] for case in figures.measured_cases()))
    cells = [[part] + [number(of_part.get(part)) for of_part in ratios.values()] for part in names]
    return text + folded("Times faster than FCL, of each part", table(["two copies, or two parts"] + list(ratios), cells))


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


METHODS = ["glissade", "glissade-paper"]
QUALITY = {"ticks": "ticks", "colliding_poses": "colliding poses", "mean_stretch": "mean stretch, mm", "final_stretch": "final stretch, mm",
           "jammed_ticks": "jammed ticks", "force_jump": "greatest force jump, N", "force_jump_of_bound": "over the bound for a tick"}
COST = {"queries_per_tick": "queries a tick", "tick_p50": "p50, µs", "tick_p99": "p99, µs"}


def by_method(figures, columns):
    """One row for each scene and method with any of these figures."""
    rows = []
    for case in figures.cases:
        for who in METHODS:
            values = [figures.get(case, who, metric) for metric in columns]
            if any(value is not None for value in values):
                rows.append([case, who] + [number(value) for value in values])
    return table(["scene", "method"] + list(columns.values()), rows) if rows else ""


def share_table(figures, case, metric, title):
    """The number of trials of a case counted by `metric`."""
    rows = [[who, number(figures.get(case, who, metric)), number(figures.get(case, who, "trials"))]
            for who in METHODS if figures.get(case, who, "trials") is not None]
    return table([title, metric, "of"], rows) if rows else ""


PEG_CASES = {"pegs-0.3mm-0.5deg": "0.3 mm and 0.5°", "pegs-1mm-1.5deg": "1 mm and 1.5°",
             "pegs-1mm-1.5deg-spiral-search": "1 mm and 1.5°, with spiral search"}
NUT = {"turns": "turns", "pitch": "pitch, mm", "advance_per_turn": "advance a turn, mm", "worst_deviation": "worst deviation, µm",
       "tick_mean": "ms a tick"}
TORTURE = {"scenes": "scenes", "milliseconds": "ms", "collisions": "colliding poses", "paths": "paths checked in full",
           "last_steps": "others, checked in their last step", "unproved_paths": "not proved",
           "below_min_clearance": "poses below the minimum clearance", "not_finite": "not finite", "least_of_min_clearance": "least distance over the minimum clearance",
           "jammed_share": "jammed, % of the ticks with the target elsewhere",
           "off_balance_share": "at rest off balance, % of these", "greatest_force_jump": "force jump over the bound for a tick",
           "hash": "hash", "hash_again": "again, on other threads"}


def peg_table(figures):
    rows = [[title, who, number(figures.get(case, who, "inserted")), number(figures.get(case, who, "trials"))]
            for case, title in PEG_CASES.items() for who in METHODS if figures.get(case, who, "trials") is not None]
    return table(["pegs, 52 µm of clearance, the ghost off by", "method", "inserted", "of"], rows) if rows else ""


def nut_table(figures):
    """Five digits: the advance is compared with the pitch."""
    rows = [[who] + [f"{figures.get('nut-turns', who, metric):.5g}" for metric in NUT]
            for who in METHODS if figures.get("nut-turns", who, "turns") is not None]
    return table(["nut turned on its bolt"] + list(NUT.values()), rows) if rows else ""


def torture_table(figures):
    """Random scenes and hands, by sliding_torture; only for Glissade, because the paper's method makes no promises to check."""
    if figures.get("torture", "glissade", "scenes") is None:
        return ""
    values = {metric: figures.get("torture", "glissade", metric) for metric in TORTURE}
    for share, metric in {"jammed_share": "jammed", "off_balance_share": "off_balance"}.items():
        values[share] = 100 * figures.get("torture", "glissade", metric) / max(1, figures.get("torture", "glissade", "wanted_elsewhere"))
    cells = [value if isinstance(value, str) else f"{value:.4g}" if value % 1 else f"{value:.0f}" for value in values.values()]
    return table(["random scenes"] + list(TORTURE.values()), [["glissade"] + cells])


def sliding(figures, _):
    text = by_method(figures, QUALITY) + by_method(figures, COST)
    text += share_table(figures, "open-sheets", "crossed", "sheets led through sheets at 0.5 to 5 m/s")
    text += peg_table(figures) + nut_table(figures) + torture_table(figures)
    rows = [[case.removeprefix("solver-")] + [number(figures.get(case, "glissade", what)) for what in ("active", "time", "time_per_active")]
            for case in figures.cases if case.startswith("solver-")]
    if rows:
        text += table(["rows of the projection", "active contacts", "time, µs", "µs an active contact"], rows)
    return text


TICK_METHODS = {"glissade": "this program", "last-force": "hold the last force", "penalty": "penalty force"}


def tick(figures, _):
    """Worst and mean errors of each scene and age; costs."""
    header = ["scene, age of the set"] + [f"{title}, {what}" for title in TICK_METHODS.values() for what in ("worst", "r.m.s.")] + ["sideways"]
    rows = []
    for case in figures.cases:
        if not case.endswith("ms"):
            continue
        name, age = case.removesuffix("ms").rsplit("-", 1)
        rows.append([f"{name}, {age} ms"] + [number(figures.get(case, method, metric)) for method in TICK_METHODS
                                             for metric in ("error_max", "error_rms")]
                    + [number(figures.get(case, "glissade", "sideways"))])
    text = table(header, rows)
    costs = [[case.removeprefix("cost-").replace("12-two-hands", "12, of two hands among four parts"), number(figures.get(case, "glissade", "time"))] for case in figures.cases if case.startswith("cost-")]
    return text + table(["rows of the set, or the envelope alone", "time of a call, µs (median of 101 means of 1000 calls)"], costs)


FEEL = {"stiffness": "stiffness, N/m", "force": "force, N", "overshoot": "overshoot, %", "settled_after": "within 2 % after, ms",
        "unrest": "change in the last second, N"}


def passivity(figures, _):
    """Stiffness by theory and in simulation; energy of random walls; what a delay feels like."""
    limits = {}
    for case in figures.cases:
        if figures.get(case, "simulation", "stiffness") is not None:
            device, delay = case.rsplit("-", 1)
            limits.setdefault(device, {})[delay.removesuffix("ms")] = case
    delays = list(next(iter(limits.values())))
    rows = [[device] + [f"{number(figures.get(case, 'glissade', 'stiffness'))}, {number(figures.get(case, 'simulation', 'stiffness'))} "
                        f"({figures.get(case, 'glissade', 'ratio_to_simulation'):.3f})" for case in cases.values()]
            for device, cases in limits.items()]
    text = table(["N/m: by theory, in simulation (ratio)"] + [f"{delay} ms" for delay in delays], rows)
    settings, least, given = (figures.get("random", "glissade", metric) for metric in ("settings", "least_energy", "most_given"))
    text += (f"Over {settings:.0f} random settings, the energy of the observer was never below {1000 * least:.1f} mJ; a wall gave a "
             f"hand at most {given:.2f} J more than it had taken.\n\n")
    rows = [[case.removeprefix("wall-").removesuffix("ms") + " ms"] + [number(figures.get(case, "glissade", metric)) for metric in FEEL]
            for case in figures.cases if case.startswith("wall-")]
    return text + table(["delay of the round trip"] + list(FEEL.values()), rows)


HANDOFFS = {"glissade": "triple buffer", "glissade-ring": "ring", "mutex": "mutex", "boost-spsc": "boost spsc_queue"}
HANDOFF_FIGURES = [("one-thread", "time"), ("two-threads", "time"), ("two-threads", "time_p99"), ("two-threads", "publish_p50"),
                   ("two-threads", "publish_p99")]


def handoff(figures, _):
    """Times of each value and way; ratios of the medians."""
    rows = []
    for name in (case for case in figures.cases if figures.get(case, "value", "size") is not None):
        size = figures.get(name, "value", "size")
        for who, title in HANDOFFS.items():
            rows.append([f"{name}, {size:.0f} B, {title}"] + [number(figures.get(f"{name}-{case}", who, what)) for case, what in HANDOFF_FIGURES])
    text = table(["ns", "publish and take, one thread", "handoff, median", "handoff, p99", "publish, median", "publish, p99"], rows)
    ratios = []
    for who in ("glissade", "glissade-ring"):
        cells = []
        for case in ("one-thread", "two-threads"):
            for peer in ("mutex", "boost-spsc"):
                mean, worst = (figures.get(f"{case}-{what}", who, "ratio_to_" + peer) for what in ("geomean", "worst"))
                cells.append(f"{mean:.2f}, {worst:.2f}")
        ratios.append([HANDOFFS[who]] + cells)
    header = [f"{peer}, {case}" for case in ("one thread", "two threads") for peer in ("mutex", "spsc_queue")]
    return text + table(["times faster than (geometric mean, worst case)"] + header, ratios)


STAGES_OF_LATENCY = {"transport": "transport", "wait": "wait for the tick", "computation": "computation", "way_back": "way back",
                     "whole": "sample to force", "haptic_lateness": "haptic loop is late", "bare_lateness": "bare loop is late"}
LATENCY_RATIOS = {"ratio_lateness_p50": "lateness of the haptic loop to that of the bare loop, median",
                  "ratio_lateness_p99": "the same, 99th percentile",
                  "ratio_udpm_p50": "sample to force over udpm to a UDP round trip and half a tick, median"}


def latency(figures, _):
    """Medians and 99th percentiles of each stage; ratios."""
    cases = [case for case in figures.cases if figures.get(case, "glissade", "whole_p50") is not None]

    def cells(metric):
        return [" / ".join(number(figures.get(case, "glissade", f"{metric}_{p}")) for p in ("p50", "p99")) for case in cases]

    text = table(["µs, median / p99"] + cases, [[title] + cells(metric) for metric, title in STAGES_OF_LATENCY.items()])
    rows = [[title] + [f"{figures.get(load, 'glissade', metric):.2f}" for load in ("idle", "loaded")] for metric, title in LATENCY_RATIOS.items()]
    return text + table(["ratios", "idle", "loaded"], rows)


def ages(figures, _):
    """Ages of the answers and durations of the calls, with and without a budget of work."""
    what = {"age_p50": "age p50, ms", "age_p99": "age p99, ms", "age_max": "age worst, ms", "call_p99": "call p99, ms", "call_max": "call worst, ms",
            "lag_mean": "mean lag, mm", "ended_early": "calls ended early, %"}
    rows = [[f"{case}, {subject.replace('-', ' ')}"] + [number(figures.get(case, subject, metric)) for metric in what]
            for case in figures.cases for subject in ("without-budget", "with-budget")]
    return table(["scene"] + list(what.values()), rows)


def clasp(figures, _):
    """Times of calls."""
    what = {"call_p50": "p50, ms", "call_p99": "p99, ms", "call_max": "worst, ms", "calls": "calls"}
    rows = [[case] + [number(figures.get(case, "glissade", metric)) for metric in what] for case in figures.cases]
    return table(["hand"] + list(what.values()), rows)


SECTIONS = {"zachmann": zachmann, "close": queries, "shells": queries, "coherent": coherent, "all-pairs": all_pairs, "parts": parts,
            "build": build, "hull": hull, "scene": scene, "threads": threads, "sliding": sliding, "tick": tick, "passivity": passivity, "ages": ages, "clasp": clasp,
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
