"""Rows of ranks with known times and counts."""
import made

#: The problem: fluid particles, and interacting pairs.
FLUID, PAIRS = 8000, 2000000


def rank(own, ghosts, pairs, cut, busy=None, waiting=None, host="node", **traffic):
    """What a row says of a rank; `traffic`: (messages, bytes) of phases that have any."""
    phases = {phase: traffic.get(phase, (0, 0)) for phase in ("halo", "migrate", "send_back", "partition")}
    return {"host": host, "cores": "0", "own": own, "ghosts": ghosts, "boundary": 10, "pairs": pairs, "cut": cut,
            "busy_s": busy, "waiting_s": waiting,
            **{phase: {"messages": messages, "bytes": sent} for phase, (messages, sent) in phases.items()}}


def even(ranks, cut, busy, fluid=FLUID, pairs=PAIRS, of_cut=80):
    """`ranks` ranks with as many particles and pairs each, which wait a quarter as long as they sum; all are parts of
    `of_cut` cut pairs."""
    twice = cut == "twice"
    return [rank(fluid // ranks, fluid // ranks // 4, (pairs + (of_cut if twice else 0)) // ranks,
                 of_cut * (2 if twice else 1) // ranks, busy, None if busy is None else busy / 4, halo=(1, 1000),
                 send_back=(0 if twice else 1, 0 if twice else 300)) for _ in range(ranks)]


def place(backend="symmetric_omp", ranks=1, threads=1, cut=None, fluid=FLUID, **change):
    more = {"ranks": ranks, "cut": cut} if ranks > 1 else {}
    return made.point(backend, threads=threads, n_fluid=fluid, n_boundary=10, **more, **change)


def timed(ranks, threads, cut, sum_s, of_ranks=None, **change):
    """A point of several ranks, whose useful times are slowed in every round as all else is."""
    where = place(ranks=ranks, threads=threads, cut=cut, **change)

    def in_round(k):
        slow = made.DISTURBANCE[(k - 1) % 6]
        found = even(ranks, cut, sum_s, where["n_fluid"]) if of_ranks is None else of_ranks
        return {"ranks": [{**one, **{name: one[name] * slow for name in ("busy_s", "waiting_s")}} for one in found]}

    return where, sum_s, in_round


def untimed(ranks, threads, cut, **change):
    """A point that was counted alone."""
    where = place(ranks=ranks, threads=threads, cut=cut, **change)
    return where, 1.0, {"phases": None, "untimed": f"{ranks} ranks on 2 cores of node",
                        "ranks": even(ranks, cut, None, where["n_fluid"])}


def strong():
    """1, 2 and 4 cores by threads alone, by ranks of one thread, and of two; and more ranks than there are cores."""
    points = [(place(threads=threads), time) for threads, time in ((1, 1.0), (2, 0.625), (4, 0.5))]
    points += [timed(2, 1, "twice", 0.5), timed(2, 1, "once", 0.4), timed(4, 1, "twice", 0.3125),
               timed(4, 1, "once", 0.25), timed(2, 2, "twice", 0.3125), timed(2, 2, "once", 0.5)]
    return points + [untimed(8, 1, "twice"), untimed(8, 1, "once")]


def weak(off=0.0):
    """As many particles on 1, 2 and 4 ranks, but for a part."""
    sizes = {"dx": 0.005, "H": 0.01}
    found = [(place(), 1.0)]
    for ranks, time in ((2, 1.25), (4, 1.6)):
        fluid = round(FLUID * ranks * (1 + off))
        found.append(timed(ranks, 1, "twice", time, fluid=fluid, **sizes, dt=1e-5 / ranks))
    return found


def study(points, **how):
    return made.study(points, before=[made.environment(cores=8)], **how)
