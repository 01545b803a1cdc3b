"""Read back what a figure has drawn."""
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.text import Text

import style


def panels(figure):
    """Return {panel title on one line: axes}."""
    return {axes.get_title(loc="left").replace("\n", " "): axes for axes in figure.axes}


def lines(axes):
    """Return {label: [(x, y)]} of the named lines, without reference lines."""
    return {line.get_label(): list(zip(*line.get_data())) for line in axes.lines
            if not line.get_label().startswith("_") and line.get_label() not in (
                "ideal", "equal", "machine flops", "machine bandwidth")}


def intervals(axes):
    """Return {label: [(x, low, high)]} of the error bars."""
    found = {}
    for container in axes.containers:
        if container.get_label().startswith("interval "):
            segments = container[2][0].get_segments()
            found[container.get_label()[len("interval "):]] = [
                (low[0], low[1], high[1]) for low, high in segments]
    return found


def colours(figure):
    """Return {backend: set of colours} of all lines and bars named after a backend."""
    found = {}
    for axes in figure.axes:
        named = [(line.get_label(), line.get_color()) for line in axes.lines]
        named += [(bars.get_label(), bar.get_facecolor()) for bars in axes.containers
                  for bar in bars if hasattr(bar, "get_facecolor")]
        for label, colour in named:
            backend = label.split(" ")[0]
            if backend in style.BACKENDS:
                found.setdefault(backend, set()).add(to_hex(colour).upper())
    return found


def shown_ticks(axis):
    """Return the tick labels within the limits; matplotlib keeps others that it does not draw."""
    low, high = sorted(axis.get_view_interval())
    return [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]


def _overlap(one, other):
    """Tell whether two boxes (left, low, right, high) overlap."""
    return one[0] <= other[2] and other[0] <= one[2] and one[1] <= other[3] and other[1] <= one[3]


def overlaps(figure):
    """Return pairs of texts whose boxes overlap, and texts that leave the figure."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    renderer = canvas.get_renderer()
    texts = list(figure.texts)
    for axes in figure.axes:
        texts += [*axes.texts, axes._left_title, axes.xaxis.label, axes.yaxis.label,
                  *shown_ticks(axes.xaxis), *shown_ticks(axes.yaxis)]
    texts = [text for text in texts if text.get_text().strip()]
    # an annotation's own extent includes its leader; the text alone is wanted
    boxes = [(text.get_text(), Text.get_window_extent(text, renderer)) for text in texts]
    inner = [(text, *box.shrunk(0.97, 0.85).extents) for text, box in boxes]  # numbers: there are many pairs
    bad = [(a, b) for i, (a, *one) in enumerate(inner) for b, *other in inner[i + 1:] if _overlap(one, other)]
    page = figure.bbox
    bad += [(text, "page") for text, box in boxes if box.x0 < 0 or box.y0 < 0
            or box.x1 > page.x1 or box.y1 > page.y1]
    return bad
