"""Find what a page would load from elsewhere."""
import re
from html.parser import HTMLParser

_LOADS = {"src", "srcset", "href", "xlink:href", "poster", "data", "action", "formaction", "background",
          "ping", "manifest", "cite"}
_IN_STYLE = re.compile(r"url\(\s*['\"]?([^)'\"]*)|@import\s+['\"]?([^'\";\s]+)")
_ADDRESS = re.compile(r"(?:https?|wss?|ftp)://[^\s\"'<>)]+")


class _Finder(HTMLParser):
    def __init__(self):
        super().__init__()
        self.found, self.inside = [], ""

    def handle_starttag(self, tag, attrs):
        self.inside = tag if tag in ("style", "script") else ""
        for name, value in attrs:
            value = (value or "").strip()
            if name.startswith("xmlns"):
                continue
            if name in _LOADS and not value.startswith(("#", "data:")):
                self.found.append(f"<{tag} {name}> {value}")
            elif name != "aria-label" and _ADDRESS.search(value):
                self.found.append(f"<{tag} {name}> {value}")
            self.style(value if name in ("style", "fill", "stroke", "clip-path", "filter", "mask") else "")

    def handle_endtag(self, tag):
        self.inside = ""

    def handle_data(self, data):
        if self.inside == "style":
            self.style(data)
        if self.inside:
            self.found += [f"<{self.inside}> {address}" for address in _ADDRESS.findall(data)]

    def style(self, text):
        """Note the addresses in a style that are not of the page itself."""
        for pair in _IN_STYLE.findall(text):
            address = "".join(pair)
            if not address.startswith(("#", "data:")):
                self.found.append(f"style {address}")


def external(html):
    """Return one text per reference to anything outside the page."""
    finder = _Finder()
    finder.feed(html)
    finder.close()
    return finder.found
