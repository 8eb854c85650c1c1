"""The plots of docs/benchmarks.md, drawn by gnuplot as SVG."""

import math
import subprocess

from bench_figures import HULL_PEERS, PEER_TITLES, geometric_mean, hull_times, shapes, split_case

COLORS = ["#1b6ca8", "#d1495b", "#66a182", "#edae49", "#7d5ba6", "#4a4a4a"]
DIRECTIONS = {6: "glissade-k6", 14: "glissade-k14", 18: "glissade-k18", 24: "glissade", 26: "glissade-k26"}


def gnuplot(path, size, body):
    script = f'set terminal svg size {size[0]},{size[1]} font "sans-serif,12" background rgb "white"\n'
    script += f'set output "{path}"\nset grid lc rgb "#dddddd"\nset key top left\n' + body
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def line(color, title, dashed=False):
    dash = " dt 2" if dashed else ""
    return f'with linespoints pt 7 ps 0.5 lw 1.5{dash} lc rgb "{COLORS[color]}" title "{title}"'


def data_block(name, points):
    return f"${name} << EOD\n" + "".join(f"{x} {y}\n" for x, y in points) + "EOD\n"


def panels(path, figures, subjects):
    """Time against the number of triangles, one panel for each shape, and one for the names of the lines.

    `subjects`: name and title of each line."""
    by_shape = shapes(figures)
    if not by_shape:
        return False
    columns = 3
    rows = -(-(len(by_shape) + 1) // columns)
    times = [figures.get(case, who, "time") for sizes in by_shape.values() for _, case in sizes for who, _ in subjects]
    times = [ns / 1000 for ns in times if ns is not None]
    body = f"set multiplot layout {rows},{columns}\nset logscale xy\nset format x '%.0s%c'\n"
    counts = [n for sizes in by_shape.values() for n, _ in sizes]
    body += f"set xrange [{0.7 * min(counts)}:{1.4 * max(counts)}]\nset yrange [{0.7 * min(times)}:{4 * max(times)}]\n"
    body += "set xlabel 'triangles of each object'\nset ylabel 'µs'\nset key off\n"
    for number, (shape, sizes) in enumerate(by_shape.items()):
        lines = []
        for color, (subject, title) in enumerate(subjects):
            points = [(n, figures.get(case, subject, "time")) for n, case in sizes]
            points = [(n, ns / 1000) for n, ns in points if ns is not None]
            if points:
                body += data_block(f"d{number}_{color}", points)
                lines.append(f"$d{number}_{color} " + line(color, title))
        body += f'set title "{shape}"\nplot ' + ", ".join(lines) + "\n"
    # The last panel names the lines.
    body += "unset title\nunset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\nset key center Left reverse\n"
    body += "plot " + ", ".join("NaN " + line(color, title) for color, (_, title) in enumerate(subjects)) + "\n"
    gnuplot(path, (320 * columns, 260 * rows), body)
    return True


def draw_figure_3(path, figures):
    """Figure 3 of the paper: the pure DOP-tree with both realignments, beside an OBB-tree."""
    return panels(path, figures, [("glissade-no-slab", "DOP-tree, affine"), ("glissade-brute-force", "DOP-tree, brute force"),
                                  ("fcl", "OBB-tree (FCL)")])


def draw_growth(path, figures):
    return panels(path, figures, [("glissade", "Glissade"), ("fcl", "FCL")])


def directions_sweep(figures, suffix=""):
    """(k, time relative to that of the default k: geometric mean over the cases in which all were measured)."""
    cases = [case for case in figures.measured_cases() if figures.get(case, "glissade-k6", "time") is not None]
    points = []
    for k, subject in DIRECTIONS.items():
        name = subject + suffix
        ratios = [figures.get(case, name, "time") / figures.get(case, "glissade", "time") for case in cases]
        if ratios:
            points.append((k, geometric_mean(ratios)))
    return points


def draw_directions(path, figures):
    with_slab = directions_sweep(figures)
    without = directions_sweep(figures, "-no-slab")
    if not with_slab:
        return False
    body = data_block("slab", with_slab) + data_block("pure", without)
    body += "set xlabel 'directions k'\nset ylabel 'time, default = 1'\nset xtics (6,14,18,24,26)\nset yrange [0:*]\n"
    body += "set key top right\nplot $slab " + line(0, "with the extra slab") + ", $pure " + line(1, "DOPs only") + "\n"
    gnuplot(path, (560, 320), body)
    return True


def draw_coherent(path, figures, phases):
    """Bars: for each phase of the slide the geometric mean over the meshes."""
    subjects = [("glissade-coherent", "coherent"), ("glissade", "from scratch"), ("fcl", "FCL")]
    cases = figures.measured_cases()
    body = "$bars << EOD\n"
    for phase in phases:
        values = [geometric_mean([figures.get(case, who, "time_" + phase) / 1000 for case in cases]) for who, _ in subjects]
        body += f'"{phase}" ' + " ".join(str(value) for value in values) + "\n"
    body += "EOD\nset style data histograms\nset style fill solid\nset boxwidth 0.9\nset logscale y\nset ylabel 'µs'\n"
    body += "set key outside\n"
    bars = [f'$bars using {i + 2}:xtic(1) lc rgb "{COLORS[i]}" title "{title}"' for i, (_, title) in enumerate(subjects)]
    gnuplot(path, (720, 320), body + "plot " + ", ".join(bars) + "\n")
    return True


def draw_scene(path, figures):
    """Figure 5 of the paper today: time of a frame against the number of objects, one line for each library."""
    subjects = [("glissade", "Glissade"), ("fcl", "FCL"), ("ode", "ODE"), ("bullet", "Bullet")]
    body = ""
    lines = []
    for color, (who, title) in enumerate(subjects):
        points = []
        for case in figures.cases:
            name, objects = split_case(case)
            us = figures.get(case, who, "us_per_frame")
            if name == "objects" and us is not None:
                points.append((objects, us))
        if points:
            body += data_block(who, points)
            lines.append(f"${who} " + line(color, title))
    if not lines:
        return False
    body += "set logscale xy\nset xlabel 'objects'\nset ylabel 'µs a frame'\nplot " + ", ".join(lines) + "\n"
    gnuplot(path, (560, 360), body)
    return True


HULL_LINES = {"glissade": "Glissade", "glissade-perceptron": "Glissade, perceptron"}
HULL_LINES |= {peer: PEER_TITLES[peer] for peer in HULL_PEERS}
HULL_GAPS = {"gap-1e-2": "1e-2", "gap-1e-4": "1e-4", "gap-1e-6": "1e-6", "depth-1e-3": "1e-3 deep"}


def nearest(wanted, numbers):
    return min(numbers, key=lambda n: abs(math.log(n / wanted)))


def hull_points(times, subject, x, fixed):
    """(x, µs) of one subject over the cases whose fields are as in `fixed`; `x` is a field, too."""
    points = []
    for case, us in times.items():
        if subject in us and fixed.items() <= case._asdict().items():
            at = getattr(case, x)
            points.append((list(HULL_GAPS).index(at) if x == "gap" else at, us[subject]))
    return sorted(points)


def hull_panels(times):
    """(title, x, settings, fields of the solid lines, of the dashed ones). Sizes that are missing are replaced by the nearest.

    Spheres on the left, as in the paper; the line of centres, where some begin, is not typical of ellipsoids."""
    ticks = ", ".join(f"'{title}' {i}" for i, title in enumerate(HULL_GAPS.values()))
    by_gap = f"set xtics ({ticks})\nset xrange [-0.3:3.3]\nset xlabel 'gap, by the size'\n"
    by_pace = "set logscale x\nset xtics (0.05, 0.5, 5)\nset format x '%g'\nset xrange [0.04:6.3]\nset xlabel 'degrees a step'\n"
    sizes = {case.corners for case in times}
    by_size = f"set logscale x\nset xtics auto\nset xrange [{0.8 * min(sizes)}:{1.25 * max(sizes)}]\n"
    by_size += "set format x '%.0s%c'\nset xlabel 'corners of each hull'\n"
    small, large = nearest(1000, sizes), nearest(20000, sizes)
    two_sizes = f"{small:,} corners" + (f"; dashed: {large:,}" if small != large else "")
    near = {"gap": "gap-1e-4"}
    slow = {"degrees": 0.05}
    return [(f"sphere, {small:,} corners, 0.05° a step", "gap", by_gap, slow | {"shape": "sphere", "corners": small}, None),
            (f"ellipsoid, {large:,} corners, 0.05° a step", "gap", by_gap, slow | {"shape": "ellipsoid", "corners": large}, None),
            ("sphere, gap 1e-4, 0.05° a step; dashed: 5°", "corners", by_size,
             near | slow | {"shape": "sphere"}, near | {"shape": "sphere", "degrees": 5}),
            ("ellipsoid, gap 1e-4, " + two_sizes, "degrees", by_pace, near | {"shape": "ellipsoid", "corners": small},
             near | {"shape": "ellipsoid", "corners": large} if small != large else None)]


def draw_figure_4(path, figures):
    """Figure 4 of the paper: convex hulls by distance, number of corners and rotational velocity."""
    times = hull_times(figures)
    if not times:
        return False
    data = ""
    plots = []
    for title, x, settings, *variants in hull_panels(times):
        lines = []
        for dashed, fixed in enumerate(variants):
            for color, subject in enumerate(HULL_LINES):
                points = hull_points(times, subject, x, fixed) if fixed else []
                if len(points) > 1:
                    name = f"{x}{len(plots)}_{dashed}_{color}"
                    data += data_block(name, points)
                    lines.append(f"${name} " + line(color, "", dashed))
        if lines:
            plots.append((f'{settings}set title "{title}"\n', lines))
    if not plots:
        return False
    # The last panel names the lines, below all.
    plots[-1][1].extend("NaN " + line(color, title) for color, title in enumerate(HULL_LINES.values()))
    every_time = [us for by_subject in times.values() for us in by_subject.values()]
    body = data + "set multiplot layout 2,2 margins 0.09,0.98,0.17,0.94 spacing 0.1,0.18\nset logscale y\nset ylabel 'µs'\n"
    body += f"set yrange [{0.7 * min(every_time)}:{1.4 * max(every_time)}]\n"
    body += "set key at screen 0.5,0.02 center bottom vertical maxrows 2 Left reverse width -4\n"
    body += "".join(f"{settings}plot " + ", ".join(lines) + "\n" for settings, lines in plots)
    gnuplot(path, (860, 640), body)
    return True


def draw_build(path, figures):
    """Build time a triangle against size, geometric mean over the shapes."""
    sizes = {}
    for case in figures.cases:
        triangles = split_case(case)[1]
        if triangles:
            sizes.setdefault(triangles, []).append(case)
    body = ""
    lines = []
    for color, who in enumerate(["glissade", "fcl", "ode", "bullet", "cgal"]):
        points = []
        for n, cases in sorted(sizes.items()):
            times = [figures.get(case, who, "time") for case in cases]
            if all(times):
                points.append((n, geometric_mean(times) / 1e6))
        body += data_block(who, points)
        lines.append(f"${who} " + line(color, who))
    body += "set logscale xy\nset format x '%.0s%c'\nset xlabel 'triangles'\nset ylabel 'ms'\nplot " + ", ".join(lines) + "\n"
    gnuplot(path, (560, 360), body)
    return True
