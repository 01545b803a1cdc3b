"""A figure as SVG in a page: text stays text, its colours follow the page, what is pointed at says its values."""
import html
import re

from matplotlib.figure import Figure

from . import rendered
from .marks import TOLD
from .style import BACKENDS, GRID, INK, MUTED, RULE, Look

#: Colours that change in the dark -> the page's CSS variable; all others stay.
_VARIABLES = {INK: "--ink", MUTED: "--muted", RULE: "--rule", GRID: "--grid", BACKENDS["naive"]: "--black"}


def inline(figure: Figure, look: Look, salt: str, label: str) -> str:
    """The figure without title and footer, which the page says itself; the label is for readers who cannot see it.
    `salt` is another for every figure of the page."""
    figure.patch.set_visible(False)
    for axes in figure.axes:
        axes.patch.set_visible(False)
    for text in figure.texts:
        text.set_visible(False)
    svg = rendered(figure, "svg", look, salt).decode()
    svg = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->|<defs>\s*<style.*?</style>\s*</defs>", "", svg, flags=re.DOTALL)
    used = set(re.findall(r'(?:url\(|href=")#([^)"]+)', svg))
    svg = _with_titles(svg[svg.index("<svg"):])
    svg = re.sub(r"<[^>]*>", lambda tag: _tag(tag[0], used), svg)
    svg = re.sub(r">\s+<", "><", svg)
    width, (top, bottom) = figure.get_size_inches()[0], figure.inner
    return (f'<svg class="figure" role="img" aria-label="{html.escape(label)}" viewBox="0 {72 * top:.1f} '
            f'{72 * width:.1f} {72 * (bottom - top):.1f}" style="--w:{96 * width:.0f}px">' + svg[svg.index(">") + 1:])


def _with_titles(svg: str) -> str:
    """What marks.told() said of artists, as titles of their shapes in turn."""
    told: list[str] = []
    shape = ""

    def shaped(found: re.Match) -> str:
        nonlocal told, shape
        if found["shape"]:
            shape, told = found["shape"], found["texts"].split("\n")[::-1]
            return "<g>"
        if told and found["tag"] == shape:
            return f"<{found['rest']}><title>{told.pop()}</title></{shape}>"
        return found[0]

    return re.sub(rf'<g id="{TOLD}(?P<shape>\w+):(?P<texts>[^"]*)">|<(?P<rest>(?P<tag>use|path)\b[^>]*)/>', shaped, svg)


def _tag(tag: str, used: set[str]) -> str:
    """A tag without what nobody needs, in the colours of the page."""
    tag = re.sub(r' id="([^"]*)"', lambda name: name[0] if name[1] in used else "", tag).replace("xlink:href", "href")
    tag = re.sub(r"-?\d+\.\d{2,}", lambda number: f"{float(number[0]):.2f}".rstrip("0").rstrip("."), tag)
    tag = re.sub(r"font: ((?:bold )?)([\d.]+)px '[^']*'(?:, [^;\"]*)?",
                 lambda found: f"font-size:{found[2]}px" + (";font-weight:700" if found[1] else ""), tag)
    tag = re.sub(r"stroke-line(?:join|cap): [a-z]+;? ?", "", tag)
    for colour, variable in _VARIABLES.items():
        tag = re.sub(colour, f"var({variable})", tag, flags=re.IGNORECASE)
    return re.sub(r"\s+", " ", tag).replace("; ", ";").replace(": ", ":")
