"""Numbers as a reader wants them. A number that is not known is an empty text."""


def number(value, digits=4):
    """Return a number with so many significant digits, without an exponent where it reads well."""
    if value is None:
        return ""
    if isinstance(value, int):
        return str(value)
    text = f"{value:#.{digits}g}".rstrip(".")
    if "e" in text and 1 <= abs(value) < 1e12:
        return f"{value:.0f}"
    return text


def time(seconds):
    """Return a duration with its unit."""
    for scale, unit in ((1, "s"), (1e-3, "ms"), (1e-6, "\N{MICRO SIGN}s")):
        if seconds >= scale:
            return f"{seconds / scale:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def interval(row):
    """Return "low to high" of a row, or an empty text."""
    if row.get("low") is None or row.get("high") is None:
        return ""
    return f"{number(row['low'], 3)} to {number(row['high'], 3)}"


def confident(row):
    """Return an interval with its confidence, or that there is none."""
    if not interval(row):
        return "no interval: too few rounds"
    level = row.get("confidence")
    return f"{100 * level:.3g} % interval {interval(row)}" if level else f"interval {interval(row)}"


def threads(count):
    """Return "1 thread" or "2 threads"."""
    return f"{count} thread{'s' * (count != 1)}"
