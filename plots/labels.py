"""Direct labels at line ends that do not overlap."""
import functools

from matplotlib.textpath import TextPath

import style

STEP = 0.165    # inches between labels
LEADER = 0.26   # inches from a line's end to its label


@functools.lru_cache(maxsize=None)
def _per_point(text):
    """Return the inches per point of font size: outlines take a quarter of the time of a figure, and texts recur."""
    return TextPath((0, 0), text, size=1).get_extents().width / 72 if text.strip() else 0.0


def text_width(text, size):
    """Return the inches that a text takes at a font size in points."""
    return size * _per_point(text)


def room(texts):
    """Return the inches that the longest of the labels needs right of a panel."""
    return LEADER + 0.15 + max((text_width(text, style.SMALL) for text in set(texts)), default=0)


def tick_room(texts):
    """Return the inches that the longest of the tick labels needs left of a panel."""
    return 0.3 + max(text_width(text, style.SMALL + 0.5) for text in set(texts))


def spread(wanted, step, low, high):
    """Move sorted positions apart to at least `step`, as little as possible, within low..high.

    If they do not all fit, the step is kept and they stand around the middle.
    """
    blocks = []  # isotonic regression of wanted[i] - i*step: [sum, count]
    for index, value in enumerate(wanted):
        blocks.append([value - index * step, 1])
        while len(blocks) > 1 and blocks[-2][0] / blocks[-2][1] > blocks[-1][0] / blocks[-1][1]:
            total, count = blocks.pop()
            blocks[-1][0] += total
            blocks[-1][1] += count
    means = [total / count for total, count in blocks for _ in range(count)]
    last = high - (len(wanted) - 1) * step
    if last < low:
        low = last = (low + last) / 2
    return [min(max(mean, low), last) + index * step for index, mean in enumerate(means)]


def at_ends(axes, ends, references=()):
    """Label line ends: ends = [(x, y, text, colour)], references likewise. Set the limits before.

    The labels stand right of the panel, or right of the points where all lines end early at one x;
    the labels of reference lines always stand right of the panel.
    """
    everything = [*ends, *references]
    if not everything:
        return
    box = axes.get_position()
    height, width = (part * size for part, size in
                     zip((box.height, box.width), axes.figure.get_size_inches()[::-1]))
    to_panel = axes.transData + axes.transAxes.inverted()
    spots = [to_panel.transform((x, y)) for x, y, _, _ in everything]
    places = [x for x, _ in spots[:len(ends)]]
    early = max(places) if places and max(places) - min(places) < 1e-9 and max(places) < 0.7 else 1
    order = sorted(range(len(spots)), key=lambda index: (spots[index][1], -index))
    heights = spread([min(max(spots[index][1], 0.0), 1.0) for index in order], STEP / height,
                     0.6 * STEP / height, 1.0)
    for index, at in zip(order, heights):
        x, y, text, colour = everything[index]
        start = (early if index < len(ends) else 1) + LEADER / width
        axes.annotate(text, xy=(x, y), xytext=(start, at), textcoords="axes fraction",
                      fontsize=style.SMALL, va="center", annotation_clip=False,
                      arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 1.1,
                                  "shrinkA": 0, "shrinkB": 4, "relpos": (0, 0.5)})
