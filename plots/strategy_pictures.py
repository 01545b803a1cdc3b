#!/usr/bin/env python3
"""Draw what each strategy's units of work write to, for docs/strategies.md: one SVG per backend.

    strategy_pictures.py docs/strategies/units.json --out docs/strategies [--png DIR] [--only NAME,...]

The data come from tests/kernels/strategy_units.cpp, which runs the backends; nothing is drawn by rule.
"""
import argparse
import io
import json
import pathlib
import re
import sys
import textwrap

import matplotlib
from matplotlib.figure import Figure
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path

from pairsum_results.figures.style import INK, Look, applied

TEXT, SMALL_TEXT, TITLE = 9.5, 8.5, 13  # points

#: Fills of neighbouring units: Okabe-Ito without yellow and black.
FILLS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00")
LIGHT = 0.40
MOST = 8  # small panels
SHARED = "#111111"
MAIN, SMALL, ROW = 3.95, 1.08, 0.33  # inches

ONE_AT_A_TIME = "A patch is one unit of work: one thread adds to it, no other."
NO_TOUCH = "Patches of a pass share no cell, so all of them may run at once. Then all threads meet, and the next pass begins."

#: What is drawn: (kind, title, what base and rest of a patch are, notes).
PICTURES = {
    "naive_omp": ("gather", "a thread writes the cell it visits, and reads the cells around it",
                  "cell visited, and written to", None,
                  "A patch is one unit of work. No unit writes outside its patch, so all run at once, in one pass. Dashed: "
                  "what two of them read. Each pair is met from both sides, and computed twice."),
    "naive_tiles_omp": ("gather", "blocks of cells; a thread writes its block alone",
                        "block of cells, written to", None,
                        "A patch is one unit of work. No unit writes outside its patch, so all run at once, in one pass. Dashed: "
                        "what one of them reads."),
    "sphysics_sweep": ("sample", "a cell with its forward neighbours; one cell after the other",
                       "cell visited", "forward neighbours, written to as well",
                       "Three visits of the sweep. Hatched: cells that two of them write to. One thread makes all visits in turn; "
                       "two threads at a time would be in conflict there."),
    "ppm_stencil": ("sample", "every cell is the base of a block; one block after the other",
                    "base cell", "other cells of the block, written to as well",
                    "Three neighbouring blocks. Hatched: cells that two of them write to. One thread does all blocks in turn."),
    "symmetric_omp": ("colours", "blocks of 2 x 2 cells in four passes", "base cell", "other cells of the block", None),
    "tiles_omp": ("colours", "blocks of cells on vector units, in four passes", "cells of the block",
                  "cells beside it that it writes to", None),
    "colour18": ("colours", "one cell with its forward neighbours at a time, in six passes", "cell visited",
                 "forward neighbours, written to as well", None),
    "colour18_seam": ("colours", "the same on a torus of 8 x 8 cells, which 3 does not divide", "cell visited",
                      "forward neighbours, written to as well",
                      "Patches at an edge go on at the opposite one. Three colours along x do not go round 8 cells: the pattern is "
                      "0 1 2 3 0 1 2 3, with a fourth colour at the seam."),
    "colour4": ("colours", "base blocks in plus-shaped packs and the squares between them, in three passes",
                "base cells of the pack", "cells ahead of it that it writes to",
                "The plus-shaped packs have two colours, like a chessboard; the squares are the third pass."),
    "half_cells": ("colours", "blocks of 3 x 3 half cells, in nine passes", "base half cell",
                   "other half cells of the block", None),
    "half_cells_seam": ("colours", "the same on a torus of 8 x 8 cells, that is 16 x 16 half cells", "base half cell",
                        "other half cells of the block",
                        "Patches at an edge go on at the opposite one. 3 does not divide 16: along each axis the pattern is "
                        "0 1 2 3 once and then 0 1 2. Of 16 passes nine are like the large one; six have 5 patches and one has a single one, "
                        "the colours of the seam: three of each kind are shown."),
    "pair_list_omp": ("colours", "slabs of two layers of cells, in two passes", "cells whose rows are swept",
                      "cells beside them, where partners lie", None),
    "verlet_list": ("colours", "the same slabs, of cells as wide as H and the skin", "cells whose rows are swept",
                    "cells beside them, where partners lie", None),
    "sliced_2colour": ("colours", "slabs of two layers of cells, in two passes", "cells swept",
                       "the next layer, written to as well", None),
    "sliced_locks": ("locks", "a slab of cell layers for each of three threads", "cells swept",
                     None,
                     "A patch is one thread's slab. Its last layer also writes to the first layer of the next slab. Hatched: "
                     "written to only by who holds that lock. There is one pass."),
    "task_conflicts": ("tasks", "blocks of cells are tasks that wait for each other", "cells of the block",
                       "cells beside it that it writes to",
                       "An edge joins two tasks that write to a common cell: the one with the higher colour waits for the "
                       "other. The colours only say who waits; no thread waits for a whole colour."),
    "atomic_add": ("sample", "a cell with its forward neighbours; every addition is atomic", "cell visited",
                   "forward neighbours, written to as well",
                   "Three units that threads may do at the same time. Hatched: cells that two of them write to. There the "
                   "additions of several threads take turns, one number at a time."),
    "thread_private": ("copies", "each thread adds to a copy of the rates of its own", "cells that the thread swept",
                       "their neighbours, written to as well",
                       "Three threads that were given 32 cells at a time. White: not touched, but zeroed and added up all the same. "
                       "The copies overlap, and are added up after the sum."),
    "per_pass_buffers": ("passes", "each pass adds to a copy of the rates of its own", "base cell", "other cells of the block",
                         "Patches in one copy share no cell, and copies are not shared: so blocks of all four may run at the same time. "
                         "No barrier until the copies are added up."),
    "touched_blocks": ("pieces", "pieces of the cells; what two pieces write to is buffered", "cells swept",
                       None,
                       "A patch is one piece, and also writes to the layer above it. Hatched: cells with particles that two pieces write to; each piece adds to a buffer of "
                       "its own there. Elsewhere it adds to the rates at once. Buffers hold 64 particles each, and may reach into one cell more."),
}


def main(arguments=None):
    """Draw the pictures; 2 for data that lack a backend."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("units", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--png", type=pathlib.Path, help="a folder for the same as PNG")
    parser.add_argument("--only", default="")
    options = parser.parse_args(arguments)
    data = json.loads(options.units.read_text(encoding="utf-8"))
    names = options.only.split(",") if options.only else list(PICTURES)
    missing = [name for name in names if name not in data or name not in PICTURES]
    if missing:
        print(f"strategy_pictures: no units, or no words, for {', '.join(missing)}", file=sys.stderr)
        return 2
    for folder in filter(None, (options.out, options.png)):
        folder.mkdir(parents=True, exist_ok=True)
    with applied(Look()):
        for name in names:
            figure = draw(name, data[name])
            (options.out / f"{name}.svg").write_text(svg(figure), encoding="utf-8")
            if options.png:
                figure.savefig(options.png / f"{name}.png", dpi=90)
    return 0


def svg(figure):
    """Return the figure as SVG, with two decimals: a hundredth of a point is enough."""
    stream = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "pairsum"}):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return re.sub(r"-?\d+\.\d{3,}", lambda number: f"{float(number[0]):.2f}".rstrip("0").rstrip("."), stream.getvalue())


def draw(name, world):
    """Return the figure of one strategy."""
    kind, title, base, rest, note = PICTURES[name]
    page = Page(name, title, world)
    passes = [written(units) for units in world["passes"]]
    if kind in ("copies", "passes"):
        page.equal_panels(passes if kind == "passes" else [[unit] for unit in passes[0]],
                          ["copy of " + ("pass" if kind == "passes" else "thread") + f" {k + 1}" for k in range(4)],
                          one_fill=kind == "copies")
    elif kind == "sample":
        page.main([passes[0][k] for k in sample(passes[0], world["cells"])], "three units of work")
    elif kind in ("gather", "locks", "pieces"):
        page.main(passes[0], f"the only pass: {len(passes[0])} units")
    elif kind == "tasks":
        page.tasks(world, passes)
    else:
        busiest = max(range(len(passes)), key=lambda k: len(passes[k]))
        page.main(passes[busiest], f"pass {busiest + 1} of {len(passes)}: {len(passes[busiest])} units")
        page.others([(f"pass {k + 1}: {len(passes[k])}", passes[k]) for k in shown(passes, busiest)])
    if note is None or name.endswith("seam") or name == "colour4":
        note = f"{ONE_AT_A_TIME} {NO_TOUCH}" + (f" {note}" if note else "")
    page.finish(base, rest, note, hatched={"sample": "written to by two of the three", "pieces": "two pieces write there: into buffers",
                                           "locks": "written to under a lock"}.get(kind), dashed=kind == "gather")
    return page.figure


def written(units):
    """Return the units that write to anything."""
    return [unit for unit in units if unit.get("rates") or unit.get("copy")]


def shown(passes, main):
    """Return which other passes to show: all, or of many three of each number of units."""
    others = [k for k in range(len(passes)) if k != main]
    if len(others) <= MOST:
        return others
    sizes = [len(units) for units in passes]
    return [k for k in others if sum(sizes[other] == sizes[k] for other in others if other < k) < 3]


def sample(units, cells):
    """Return three units in the middle, that overlap in part."""
    middle = cells // 2
    wanted = [(middle - 2, middle), (middle - 1, middle), (middle + 1, middle + 1)]
    own = {tuple(unit["own"][0]): k for k, unit in enumerate(units)}
    return [own[place] for place in wanted]


class Page:
    """A figure with a large panel, small ones beside it, and words above and below."""

    def __init__(self, name, title, world):
        self.name, self.title, self.world = name, title, world
        self.n = world["cells"] * world["parts"]
        self.panels = []  # (left, top from the panels' top, size, title, painter)
        self.width = self.height = 0.0

    def main(self, units, title):
        """Place the large panel."""
        self.panels.append((0.0, 0.0, MAIN, title, lambda axes: self.paint(axes, units, large=True)))
        self.width, self.height = MAIN, MAIN

    def others(self, panels):
        """Place small panels right of it, in columns as high as it is."""
        size, step = (SMALL, SMALL + ROW) if len(panels) > 2 else (1.6, 1.6 + ROW)
        rows = max(1, int((MAIN + ROW) / step))
        for k, (title, units) in enumerate(panels):
            left = MAIN + 0.35 + (k // rows) * (size + 0.3)
            self.panels.append((left, (k % rows) * step, size, title,
                                lambda axes, units=units: self.paint(axes, units, large=False)))
            self.width = max(self.width, left + size)

    def equal_panels(self, groups, titles, one_fill):
        """Place panels of one size in rows of two, or three."""
        across = 3 if len(groups) == 3 else 2
        size = 2.4
        for k, (units, title) in enumerate(zip(groups, titles)):
            left, top = (k % across) * (size + 0.3), (k // across) * (size + ROW)
            self.panels.append((left, top, size, title,
                                lambda axes, units=units, k=k: self.paint(axes, units, large=False, fill=k if one_fill else None)))
            self.width, self.height = max(self.width, left + size), top + size

    def tasks(self, world, passes):
        """Place the graph of tasks, and what the tasks of each colour write to."""
        self.panels.append((0.0, 0.0, MAIN, f"{sum(map(len, passes))} tasks, a colour each, and who waits for whom",
                            lambda axes: self.paint_graph(axes, world, passes)))
        self.width, self.height = MAIN, MAIN
        self.others([(f"colour {k} writes to", units) for k, units in enumerate(passes)])

    def paint(self, axes, units, large, fill=None):
        """Fill what each unit writes to, its own cells darker, and draw the grid and the units' outlines."""
        fills = [fill] * len(units) if fill is not None else spread(units, self.n, self.world["grid"] == "hashed_grid")
        counts = {}
        for unit in units:
            for cell in touched(unit):
                counts[cell] = counts.get(cell, 0) + 1
        dark, light, edges = {}, {}, []
        overlapping = self.name in ("sphysics_sweep", "ppm_stencil", "atomic_add")
        for unit, colour in zip(units, fills):
            own = {tuple(cell) for cell in unit["own"]}
            cells = touched(unit)
            shade = FILLS[colour % len(FILLS)]
            dark.setdefault(shade, []).extend(cells & own)
            light.setdefault(shade, []).extend(cells - own)
            edges.extend(outline(cells))
        for shade, cells in light.items():
            fill_cells(axes, cells, facecolor=shade, alpha=LIGHT, linewidth=0, zorder=1.5)
        for shade, cells in dark.items():
            fill_cells(axes, cells, facecolor=shade, alpha=0.6 if "reads" in units[0] else 0.95, linewidth=0, zorder=1.4 if overlapping else 1.6)
        draw_lines(axes, edges, edgecolor=INK, linewidth=1.3 if large else 0.7 / self.world["parts"], zorder=3, capstyle="projecting")
        hatched, locked = set(), {}
        if overlapping:
            hatched = {cell for cell, k in counts.items() if k > 1}
        elif self.name == "touched_blocks":
            hatched = {tuple(c) for unit in units for c in unit["copy"]}
        for unit in units:
            for lock, cells in unit.get("locks", {}).items():
                inside = [tuple(c) for c in cells]
                rows = [y for _, y in inside]
                border = max(set(rows), key=lambda y: (sum(1 for u in units for c in touched(u) if c[1] == y), y))
                hatched |= {c for c in inside if c[1] == border}
                locked[lock] = border
        for lock, layer in locked.items():
            axes.text(self.n + 0.15, layer + 0.5, f"lock {lock}", fontsize=SMALL_TEXT, va="center")
        if hatched:
            fill_cells(axes, hatched, facecolor="none", edgecolor=SHARED, hatch="////", linewidth=0, zorder=2.5)
        if units and "reads" in units[0]:
            for k in self.readers(units):
                draw_lines(axes, outline({tuple(c) for c in units[k]["reads"]}), edgecolor=INK, linewidth=2.6,
                           linestyle=(0, (2, 1)), zorder=4)
        self.grid(axes, large)

    def readers(self, units):
        """Return two units far apart whose reads are drawn."""
        def nearest(to):
            return min(range(len(units)), key=lambda k: sum(abs(sum(axis) / len(axis) + 0.5 - to * self.n)
                                                            for axis in zip(*units[k]["own"])))
        return {nearest(0.3), nearest(0.7)} if len(units) > 9 else {nearest(0.5)}

    def paint_graph(self, axes, world, passes):
        """Draw tasks in the fill of their colour, with lines between those that conflict."""
        centres = []
        for colour, units in enumerate(passes):
            for unit in units:
                cells = {tuple(cell) for cell in unit["own"]}
                fill_cells(axes, cells, facecolor=FILLS[colour], alpha=0.55, linewidth=0, zorder=1.5)
                draw_lines(axes, outline(cells), edgecolor=INK, linewidth=1.3, zorder=3)
                centres.append((sum(c[0] for c in cells) / len(cells) + 0.5, sum(c[1] for c in cells) / len(cells) + 0.5, colour))
        for a, b in world["edges"]:
            (x, y, _), (x2, y2, _) = centres[a], centres[b]
            back = 0.62 / ((x2 - x) ** 2 + (y2 - y) ** 2) ** 0.5
            axes.annotate("", (x2 - back * (x2 - x), y2 - back * (y2 - y)), (x + back * (x2 - x), y + back * (y2 - y)), zorder=4,
                          arrowprops={"arrowstyle": "-|>", "color": INK, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0,
                                      "mutation_scale": 8})
        for x, y, colour in centres:
            axes.text(x, y, str(colour), ha="center", va="center", fontsize=TEXT, weight="bold", zorder=6,
                      bbox={"boxstyle": "circle,pad=0.22", "facecolor": "white", "edgecolor": INK, "linewidth": 0.8})
        self.grid(axes, True)

    def grid(self, axes, large):
        """Draw the lines between cells; between half cells thinner ones."""
        parts = self.world["parts"]
        for step, width, colour in ((1, 0.4, "#bdbdbd"), (parts, 0.9 if parts > 1 else 0.5, "#8a8a8a")):
            if step < parts and not large:
                continue
            lines = [[(k, 0), (k, self.n)] for k in range(0, self.n + 1, step)]
            lines += [[(0, k), (self.n, k)] for k in range(0, self.n + 1, step)]
            draw_lines(axes, lines, edgecolor=colour, linewidth=width * (1 if large else 0.6), zorder=2)
        axes.set_xlim(-0.08, self.n + 0.08)
        axes.set_ylim(-0.08, self.n + 0.08)
        axes.set_aspect("equal")
        axes.axis("off")

    def finish(self, base, rest, note, hatched, dashed):
        """Make the figure: title, panels, legend, note."""
        width = max(self.width + 0.5 + (0.5 if self.name == "sliced_locks" else 0), 6.4)
        wrap = int(width * 13.2)
        lines = textwrap.wrap(note, wrap)
        above, below = 0.95, 0.62 + 0.175 * len(lines) + 0.18
        height = above + self.height + below
        self.figure = figure = Figure(figsize=(width, height))
        figure.text(0.25 / width, 1 - 0.24 / height, self.name.replace("_seam", " at a seam"), fontsize=TITLE, weight="bold",
                    va="center")
        figure.text(0.25 / width, 1 - 0.50 / height, self.title, fontsize=TEXT, va="center", color=INK)
        for left, top, size, title, painter in self.panels:
            axes = figure.add_axes([(0.25 + left) / width, 1 - (above + top + size) / height, size / width, size / height])
            painter(axes)
            axes.text(0, self.n + 0.25 * self.n / (10 * size), title, fontsize=TEXT - 0.5 if size > 2 else SMALL_TEXT - 0.5,
                      va="bottom", weight="bold" if size > 2 else "normal")
        shade = FILLS[0]
        entries = [Patch(facecolor=shade, alpha=0.95, edgecolor=INK, label=base)]
        if rest:
            entries.append(Patch(facecolor=shade, alpha=LIGHT, edgecolor=INK, label=rest))
        if hatched:
            entries.append(Patch(facecolor="white", edgecolor=SHARED, hatch="////", label=hatched))
        if dashed:
            entries.append(Patch(facecolor="white", edgecolor=INK, linestyle=(0, (3, 2)), label="read by one unit"))
        legend = figure.legend(handles=entries, loc="upper left", ncol=len(entries), frameon=False, fontsize=SMALL_TEXT,
                               bbox_to_anchor=(0.16 / width, (below - 0.10) / height), borderpad=0, columnspacing=1.4, handlelength=1.4)
        legend.set_in_layout(False)
        for k, line in enumerate(lines):
            figure.text(0.25 / width, (below - 0.50 - 0.175 * k) / height, line, fontsize=SMALL_TEXT, va="center", color=INK)


def touched(unit):
    """Return the cells that a unit writes to, in the rates or in a copy."""
    return {tuple(cell) for name in ("rates", "copy") for cell in unit.get(name, [])}


def fill_cells(axes, cells, **look):
    """Fill cells as one shape, those side by side in a row as one rectangle."""
    corners, codes = [], []
    cells = sorted(set(cells), key=lambda cell: (cell[1], cell[0]))
    first = 0
    for k, (x, y) in enumerate(cells):
        if k + 1 == len(cells) or cells[k + 1] != (x + 1, y):
            left = cells[first][0]
            corners += [(left, y), (x + 1, y), (x + 1, y + 1), (left, y + 1), (left, y)]
            codes += [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
            first = k + 1
    if corners:
        axes.add_patch(PathPatch(Path(corners, codes), **look))


def draw_lines(axes, lines, **look):
    """Draw lines as one shape, joined where they go on straight."""
    ends = {}
    for (x, y), (x2, y2) in sorted(set(map(lambda line: tuple(map(tuple, line)), lines)), key=lambda l: (l[0][0] == l[1][0], l)):
        upright = x == x2
        before = ends.pop((x, y, upright), None)
        ends[(x2, y2, upright)] = before or (x, y)
    corners = [point for (x, y, _), start in ends.items() for point in (start, (x, y))]
    if corners:
        axes.add_patch(PathPatch(Path(corners, [Path.MOVETO, Path.LINETO] * len(ends)), facecolor="none", **look))


def outline(cells):
    """Return the edges between these cells and others."""
    edges = []
    for x, y in cells:
        for beside, edge in (((x - 1, y), [(x, y), (x, y + 1)]), ((x + 1, y), [(x + 1, y), (x + 1, y + 1)]),
                             ((x, y - 1), [(x, y), (x + 1, y)]), ((x, y + 1), [(x, y + 1), (x + 1, y + 1)])):
            if beside not in cells:
                edges.append(edge)
    return edges


def spread(units, n, closes):
    """Return a fill for each unit, another one than those of units close by."""
    of_cell, fills = {}, []
    for unit in units:
        cells = touched(unit)
        near = {}
        for x, y in cells:
            for dx in range(-2, 3):
                for dy in range(-2, 3):
                    at = ((x + dx) % n, (y + dy) % n) if closes else (x + dx, y + dy)
                    if at in of_cell:
                        near[of_cell[at]] = near.get(of_cell[at], 0) + 5 - abs(dx) - abs(dy)
        own = min(range(len(FILLS)), key=lambda k: (near.get(k, 0), (k - len(fills)) % len(FILLS)))
        fills.append(own)
        of_cell.update(dict.fromkeys(cells, own))
    return fills


if __name__ == "__main__":
    sys.exit(main())
