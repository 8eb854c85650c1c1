"""The plots of docs/benchmarks.md, drawn by gnuplot as SVG."""

import subprocess

from bench_figures import geometric_mean, shapes, split_case

COLORS = ["#1b6ca8", "#d1495b", "#66a182", "#edae49", "#7d5ba6"]
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
    """(k, time of each k by that of the default: geometric mean over the cases where all were measured)."""
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
