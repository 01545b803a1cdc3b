"""Rows of a study that fills every figure, and what a figure has drawn."""
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import to_rgb
from matplotlib.text import Text

import made
import pairsum_results as pr
from pairsum_results.load import collect
from pairsum_results.rows import read

OTHER = "fedcba9876543210"


def passes(threads, sum_s):
    """Two passes, of which the first thread spends all in summing, the last half of it."""
    busy = [[sum_s / 2 * (1 - 0.5 * k / max(threads - 1, 1)) for k in range(threads)]] * 2
    return {"threads_busy_s": busy, "barrier_wait_s": [[sum_s / 2 - one for one in some] for some in busy]}


def _point(name, M, threads, sum_s, **change):
    work = made.work(pairs_tested=8000000 + 500000 * (7 - (M or 7)))
    return made.point(name, M, threads, **change), sum_s, {"work": work, **(passes(threads, sum_s) if threads > 1 else {})}


def everything(threads=(1, 2, 4, 8, 16), rounds=6):
    """Rows that fill every figure: threads, M, granularities, sizes, builds, worlds, copies for the self-test."""
    granularity = {"omp": "dynamic:32", "tbb": "auto:32"}
    points = [_point(f"{name}_{runtime}", M, n, time * factor * {5: 1.3, 6: 1.1, 7: 1}[M] / n**0.9,
                     granularity=granularity[runtime])
              for name, time in (("naive", 1.0), ("symmetric", 0.6)) for runtime, factor in (("omp", 1), ("tbb", 1.1))
              for M in (5, 6, 7) for n in threads]
    points += [_point(name, 7, 1, time, granularity="none") for name, time in
               (("naive", 1.02), ("symmetric", 0.61), ("sphysics_sweep", 0.55))]
    points += [_point("tiles_omp", None, n, 0.2 / n, grid="compact_grid", isa="avx512", block="auto") for n in threads]
    points += [_point("symmetric_omp", 7, threads[-1], 0.6 / threads[-1] * factor, granularity=word)
               for word, factor in (("dynamic:64", 1.2), ("static:64", 1.3), ("static:8", 1.4), ("guided", 1.1))]
    points += [_point(name, 7, n, time / n, dx=0.012, H=0.024, n_fluid=100000, n_boundary=90000)
               for name, time in (("naive_omp", 0.1), ("symmetric_omp", 0.08), ("locks_omp", 0.09)) for n in threads]
    points += [_point(name, 7, n, time / n, dx=0.02, H=0.04, n_fluid=20000, n_boundary=20000)
               for name, time in (("naive_omp", 0.02), ("symmetric_omp", 0.017)) for n in threads]
    points += [(made.point(name, 7, 1), time, {"environment": OTHER}) for name, time in
               (("naive_omp", 1.2), ("symmetric_omp", 0.55))]
    points += [_point("again_naive_omp", 7, 1, 1.0), _point("slowed_20_naive_omp", 7, 1, 1.2)]
    before = [made.environment(), made.environment(OTHER, compiler="Clang 14.0.6"),
              *(made.peak(n, 1e9 * n**0.95, 2e9 * n**0.5) for n in threads)]
    return made.study(points, rounds, before)


#: H of density() in spacings -> interacting pairs.
PAIRS = {2.0: 14000, 3.0: 54000, 4.16: 140000}


def density(radii=PAIRS):
    """Rows of two states at several H, a thousand fluid particles each: the scalar symmetric sum is twice as fast as the
    gather at every H, tiles gain 1.5 at first and nothing at last."""
    points = []
    for state, slower in (("rest", 1.0), ("perturbed", 1.25)):
        for k, (radius, pairs) in enumerate(radii.items()):
            for name, ns, isa in (("naive_omp", 10, "scalar"), ("symmetric_omp", 5, "scalar"), ("copies_omp", 6, "scalar"),
                                  ("naive", 11, "scalar"), ("sphysics_sweep", 7, "scalar"),
                                  ("again_naive_omp", 1, "scalar"), ("naive_tiles_omp", 2, "avx512"),
                                  ("tiles_omp", 2 / (1.5, 1.2, 1.0)[k], "avx512")):
                place = made.point(name, None, 1, state=state, H=radius * 0.00594, n_fluid=1000, n_boundary=900,
                                   grid="compact_grid", isa=isa)
                lanes = {"vector_units": {"block": "none", "lanes": 8, "vectors": 1000, "occupancy": 0.9}} if isa != "scalar" else {}
                points.append((place, slower * ns * pairs * 1e-9, {"work": {**made.work(pairs_interacting=pairs), **lanes}}))
    return made.study(points)


def report(tmp_path, rows):
    return pr.report(collect(read([made.write(tmp_path / "study/rows.jsonl", rows)])))


def panels(figure):
    """Title on one line -> axes."""
    return {axes.get_title(loc="left").replace("\n", " ").replace("\u00a0", " "): axes for axes in figure.axes}


def names(axes):
    """What stands at the rows, from above."""
    return [label.get_text() for label in axes.get_yticklabels()]


def lines(axes):
    """Label -> [(x, y)] of the lines that are drawn and named."""
    return {line.get_label(): list(map(tuple, line.get_xydata())) for line in axes.lines
            if not line.get_label().startswith("_")}


def bars(axes, label):
    """[(left, right)] of the bars with this label, from above."""
    found = [path.get_extents() for some in axes.collections if some.get_label() == label for path in some.get_paths()]
    return [(box.x0, box.x1) for box in sorted(found, key=lambda box: box.y0)]


def dots(axes):
    """[(x, (low, high) or None)] of dots on rows, from above."""
    spots = [tuple(xy) for some in axes.collections if isinstance(some, PathCollection)
             and some.get_label() != "expected" for xy in np.ma.filled(some.get_offsets(), np.nan)]
    spans = {round(s[0][1], 6): (s[0][0], s[1][0]) for some in axes.collections
             if isinstance(some, LineCollection) for s in some.get_segments() if len(s)}
    return [(x, spans.get(round(y, 6))) for x, y in sorted(spots, key=lambda spot: spot[1]) if x == x]


def overlaps(figure):
    """Pairs of texts whose boxes overlap, and texts that leave the figure."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    texts = [*figure.texts, *(text for legend in figure.legends for text in legend.get_texts())]
    for axes in [axes for one in figure.axes for axes in (one, *one.child_axes)]:
        low, high = sorted(axes.get_ylim())
        left, right = sorted(axes.get_xlim())
        texts += [*axes.texts, axes._left_title, axes.xaxis.label, axes.yaxis.label,
                  *(tick.label1 for tick in axes.yaxis.get_major_ticks() if low <= tick.get_loc() <= high),
                  *(label for tick in axes.xaxis.get_major_ticks() if left <= tick.get_loc() <= right
                    for label in (tick.label1, tick.label2) if label.get_visible())]
    boxes = [(text.get_text(), Text.get_window_extent(text, canvas.get_renderer()))  # without an annotation's leader
             for text in texts if text.get_visible() and text.get_text().strip()]
    inner = [(text, box.shrunk(0.97, 0.85).extents) for text, box in boxes]
    bad = [(a, b) for k, (a, one) in enumerate(inner) for b, other in inner[k + 1:]
           if one[0] <= other[2] and other[0] <= one[2] and one[1] <= other[3] and other[1] <= one[3]]
    page = figure.bbox
    return bad + [(text, "page") for text, box in boxes
                  if box.x0 < -0.5 or box.y0 < -0.5 or box.x1 > page.x1 + 0.5 or box.y1 > page.y1 + 0.5]


def lightness(colour):
    """L* of CIELAB, 0 to 100: what is left of a colour in grey."""
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in to_rgb(colour)]
    y = float(np.dot(linear, (0.2126, 0.7152, 0.0722)))
    return 116 * y ** (1 / 3) - 16 if y > 0.008856 else 903.3 * y
