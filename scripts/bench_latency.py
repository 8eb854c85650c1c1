#!/usr/bin/env python3
"""Prints the figures of `glissade latency --json` as rows of results.csv: bench_latency.py LATENCY.json.

Cases are a link and a load, such as `udpm-idle`, or a load; metrics are a stage and a quantile, such as `transport_p99`.
"""

import csv
import json
import sys

LINKS = {"in process": "in-process", "memq://": "memq", "udpm://": "udpm"}


def rows_of(figures):
    for load in ("idle", "loaded"):
        for link in figures[load]["links"]:
            case = f"{LINKS[link['link']]}-{load}"
            for key, stage in link.items():
                if not isinstance(stage, dict):
                    continue
                for quantile in ("p50", "p99", "max"):
                    yield case, f"{key.removesuffix('_us')}_{quantile}", stage[quantile], "us"
            yield case, "lost", link["lost"], "1"
        for quantile in ("p50", "p99", "max"):
            yield load, f"udp_round_trip_{quantile}", figures[load]["udp_round_trip_us"][quantile], "us"
        for name, ratio in figures[load]["ratios"].items():
            yield load, f"ratio_{name}", ratio, "x"


def main():
    with open(sys.argv[1]) as file:
        figures = json.load(file)
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["bench", "case", "subject", "metric", "value", "unit"])
    for case, metric, value, unit in rows_of(figures):
        writer.writerow(["latency", case, "glissade", metric, value, unit])


if __name__ == "__main__":
    main()
