"""How a study scales on a Dask cluster: PYTHONPATH=build/release/python /usr/bin/python3 bench/study/fleet_scaling.py

First measures, on this machine, what a batch costs scheduler and controller together, and what a row costs. Then
simulates clusters of up to 1,000 cores with these costs, and with the sizes of batches that the fleet chooses. Efficiency
is the time that all cores spend on slides, over the time that they are there. Times of slides are exponentially
distributed, which is worse than those of most studies.
"""

import heapq
import json
import random
import time

import distributed

from glissade import fleet

ROW_BYTES = 600
LINK_S = 0.5e-3  # from scheduler to worker or back


def echo(slides: list[int], rows: list[str]) -> list[str]:
    return rows


def cost_of_a_batch(slides: int, batches: int = 300) -> float:
    """Processor time (s) of scheduler and controller, which share a process here."""
    cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None)
    rows = ["x" * ROW_BYTES] * slides
    with cluster, distributed.Client(cluster) as client:
        client.submit(echo, [], []).result()
        start = time.process_time()
        finished = distributed.as_completed()
        for _ in range(batches):
            finished.add(client.submit(echo, list(range(slides)), rows, pure=False))
        for _ in range(batches):
            next(finished).result()
        return (time.process_time() - start) / batches


def simulated_efficiency(cores: int, slides: int, slide_s: float, batch_cost_s: float) -> tuple[float, float]:
    """The efficiency, and the share of the time for which scheduler and controller are busy."""
    numbers = random.Random(1)
    left = slides
    free_at = 0.0  # scheduler and controller
    busy_s = work_s = end = 0.0
    queued = [0] * cores  # batches at each core
    ready = [0.0] * cores  # when a core has done all batches that it has
    events: list[tuple[float, int]] = []  # a batch comes back: time, core

    def send(core: int, now: float) -> None:
        nonlocal left, free_at, busy_s, work_s
        if left == 0:
            return
        count = min(left, fleet.batch_size(left, slide_s, cores))
        left -= count
        free_at = max(free_at, now) + batch_cost_s
        busy_s += batch_cost_s
        took = numbers.gammavariate(count, slide_s)  # the sum of so many exponential times
        work_s += took
        ready[core] = max(ready[core], free_at + LINK_S) + took
        queued[core] += 1
        heapq.heappush(events, (ready[core] + LINK_S, core))

    for _ in range(fleet.BATCHES_AHEAD):
        for core in range(cores):
            send(core, 0.0)
    while events:
        now, core = heapq.heappop(events)
        end = max(end, now)
        queued[core] -= 1
        send(core, now)
    return work_s / (cores * end), busy_s / end


def main() -> None:
    slides_of_batch = 45
    cost = cost_of_a_batch(slides_of_batch)
    print(json.dumps({"batch_cost_s": round(cost, 5), "slides_of_a_batch": slides_of_batch,
                      "cost_per_slide": f"{100 * cost / fleet.BATCH_S:.2f} %"}))
    print("cores  slides     a slide     efficiency  scheduler busy")
    for slide_s in (0.045, 0.3):  # a round peg; a window motor in a car door
        for cores, slides in [(2, 10_000), (64, 100_000), (256, 100_000), (1000, 1_000_000), (1000, 10_000_000)]:
            efficiency, busy = simulated_efficiency(cores, slides, slide_s, cost)
            print(f"{cores:5}  {slides:9}  {slide_s:6.3f} s  {100 * efficiency:9.1f} %  {100 * busy:8.1f} %")


if __name__ == "__main__":
    main()
