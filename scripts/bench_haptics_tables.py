"""The sections of the benches of sliding, haptic loop and grasping."""

from bench_figures import geometric_mean
from bench_tables import table, number

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


LED_REAL_TIME_MS = 2


def led(figures, _):
    """The whole, then each part, the slowest first."""
    def all_of(metric, cases):
        return [figures.get(case, "glissade", metric) for case in cases]

    cases = [case for case in figures.cases if figures.get(case, "glissade", "tick_p99") is not None]
    cases.sort(key=lambda case: -figures.get(case, "glissade", "tick_p99"))
    text = (f"{len(figures.cases)} parts and pairs; {sum(all_of('colliding_poses', figures.cases)):.0f} of "
            f"{sum(all_of('ticks', figures.cases)):.0f} poses collide")
    if not cases:
        return text + "; no contact was made.\n\n"
    p99 = all_of("tick_p99", cases)
    text += (f"; {len(figures.cases) - len(cases)} made no contact. p50, geometric mean: {number(geometric_mean(all_of('tick_p50', cases)))} ms; "
             f"p99: {number(geometric_mean(p99))} ms, at most {LED_REAL_TIME_MS} ms for {sum(value <= LED_REAL_TIME_MS for value in p99)}.\n\n")
    columns = {"triangles": "triangles", "ticks": "ticks", "pushed": "with contact, %", "colliding_poses": "colliding poses", "tick_mean": "mean, ms",
               "tick_p50": "p50, ms", "tick_p99": "p99, ms", "tick_max": "most, ms"}
    values = {metric: all_of(metric, cases) for metric in columns}
    values["pushed"] = [100 * value for value in values["pushed"]]
    values["triangles"] = [f"{value:.0f}" for value in values["triangles"]]
    values["ticks"] = [f"{value:.0f}" for value in values["ticks"]]
    rows = [[case] + [values[metric][i] if metric in ("triangles", "ticks") else number(values[metric][i]) for metric in columns]
            for i, case in enumerate(cases)]
    return text + table(["two copies, or two parts"] + list(columns.values()), rows)


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
