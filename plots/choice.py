"""Which of the measured points a figure shows."""
import panels


def best(rows, value):
    """Return each backend's row with the smallest value, smallest first."""
    return sorted((min(some, key=value) for _, some in panels.split(rows, "backend")), key=value)


def at_most_threads(rows):
    """Return the rows of each backend at its most threads."""
    most = {backend: max(row["threads"] for row in some)
            for backend, some in panels.split(rows, "backend")}
    return [row for row in rows if row["threads"] == most[row["backend"]]]


def sum_time(row):
    """Return the median of the summation in seconds, or None."""
    return row["phases"].get("sum_s", {}).get("median")


def best_m(rows):
    """Return of each backend and thread count the row with the smallest summation time."""
    known = [row for row in rows if sum_time(row) is not None]
    return [min(some, key=sum_time) for _, some in panels.split(known, "backend", "threads")]
