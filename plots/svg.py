"""A figure as a small inline SVG: text stays text, colours of text and rules follow the page."""
import html
import io
import re

import matplotlib

import style

#: Colours that change in the dark -> the page's CSS variable; all others stay.
_VARIABLES = {style.INK: "--ink", style.MUTED: "--muted", style.RULE: "--rule", style.GRID: "--grid",
              style.BACKENDS["naive"]: "--black"}
_PIXELS = 96  # per inch
_USED = re.compile(r'(?:url\(|xlink:href="|href=")#([^)"]+)')


def inline(figure, prefix, label):
    """Return the SVG as text to put into HTML; ids begin with the prefix, label is its text for readers."""
    figure.patch.set_visible(False)
    for axes in figure.axes:
        axes.patch.set_visible(False)
    stream = io.StringIO()
    with matplotlib.rc_context({"svg.fonttype": "none"}):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None, "Format": None,
                                                       "Type": None})
    text = stream.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->|<defs>\s*<style.*?</style>\s*</defs>", "", text, flags=re.DOTALL)
    short = {name: f"{prefix}{at}" for at, name in enumerate(dict.fromkeys(_USED.findall(text)))}
    text = re.sub(r">\s+<", "><", re.sub(r"<[^>]*>", lambda tag: _tag(tag[0], short), text))
    width, height = figure.get_size_inches()
    start = (f'<svg class="figure" role="img" aria-label="{html.escape(label)}" viewBox="0 0 '
             f'{72 * width:.1f} {72 * height:.1f}" style="--w:{_PIXELS * width:.0f}px">')
    return start + _without_bare_groups(text[text.index(">") + 1:].strip())


def _tag(tag, short):
    """Shorten one tag: ids that nobody refers to, digits and line breaks go."""
    tag = re.sub(r' id="([^"]*)"', lambda found: f' id="{short[found[1]]}"' if found[1] in short else "", tag)
    tag = _USED.sub(lambda found: found[0].replace("xlink:", "").replace(found[1], short[found[1]]), tag)
    tag = re.sub(r"-?\d+\.\d{2,}", lambda number: f"{float(number[0]):.2f}".rstrip("0").rstrip("."), tag)
    tag = re.sub(r"font: ((?:bold )?)([\d.]+)px '[^']*'(?:, [^;\"]*)?",
                 lambda found: f"font-size:{found[2]}px" + (";font-weight:700" if found[1] else ""), tag)
    tag = re.sub(r";? ?stroke-line(?:join|cap): [a-z]+|;? ?stroke-miterlimit: \d+", "", tag)
    tag = tag.replace('style="; ', 'style="')
    for colour, variable in _VARIABLES.items():
        tag = re.sub(colour, f"var({variable})", tag, flags=re.IGNORECASE)
    tag = re.sub(r' transform="rotate\(-?0 [^)]*\)"', "", tag)
    return re.sub(r"\s+", " ", tag).replace("; ", ";").replace(": ", ":").replace(" />", "/>")


def _without_bare_groups(text):
    """Drop groups that say nothing."""
    kept, said = [], []
    for part in re.split(r"(</?g\b[^>]*>)", text):
        if part == "<g/>":
            continue
        if part.startswith("<g"):
            said.append(part != "<g>")
            kept.append(part if said[-1] else "")
        else:
            kept.append(part if part != "</g>" or said.pop() else "")
    return "".join(kept)
