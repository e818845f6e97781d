"""Drawings of curves over axes as SVG text, for the pages that are built from results. Python 3 standard library."""

import math

GREY, BLUE, RED, GREEN, ORANGE, BLACK = "#9aa0a6", "#1f6fb4", "#c5221f", "#188038", "#e37400", "#000000"


def nice_step(span):
    """1, 2 or 5 times a power of ten that divides the span into about five."""
    raw = span / 5.0
    size = 10.0 ** math.floor(math.log10(raw))
    return min(s * size for s in (1, 2, 5, 10) if s * size >= raw * 0.999)


class Axis:
    """A range, linear or logarithmic. `ticks` are (value, text), or are chosen."""

    def __init__(self, low, high, ticks=None, log=False, label=""):
        self.low, self.high, self.log, self.label = low, high, log, label
        self.ticks = ticks if ticks is not None else list(self._decades() if log else self._steps())

    @classmethod
    def of(cls, values, **options):
        """Around the values, a twentieth of their range wider on both sides."""
        low, high = min(values), max(values)
        if options.get("log"):
            edge = (high / low) ** 0.05
            return cls(low / edge, high * edge, **options)
        edge = 0.05 * (high - low)
        return cls(low - edge, high + edge, **options)

    def _steps(self):
        step = nice_step(self.high - self.low)
        for k in range(math.ceil(self.low / step), math.floor(self.high / step) + 1):
            yield k * step, "%.4g" % (k * step)

    def _decades(self):
        for decade in range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high))):
            for digit in (1, 2, 5):
                value = digit * 10.0 ** decade
                if self.low <= value <= self.high:
                    yield value, "%.4g" % value

    def share(self, value):
        """Place in the range, 0 to 1; beyond it at its end."""
        scale = math.log if self.log else float
        if self.log:
            value = max(value, self.low)
        part = (scale(value) - scale(self.low)) / (scale(self.high) - scale(self.low))
        return min(max(part, 0.0), 1.0)


class Panel:
    """A frame with two axes; `svg` collects what is drawn."""

    def __init__(self, left, top, width, height, x, y, title=""):
        self.left, self.top, self.width, self.height = left, top, width, height
        self.x_axis, self.y_axis = x, y
        self.svg = list(self._frame(title))

    def x(self, value):
        return self.left + self.x_axis.share(value) * self.width

    def y(self, value):
        return self.top + (1.0 - self.y_axis.share(value)) * self.height

    def _frame(self, title):
        bottom = self.top + self.height
        for value, text in self.x_axis.ticks:
            yield ('<path d="M%.1f %d v%d" stroke="#eee"/><text x="%.1f" y="%d" text-anchor="middle">%s</text>'
                   % (self.x(value), self.top, self.height, self.x(value), bottom + 16, text))
        for value, text in self.y_axis.ticks:
            yield ('<path d="M%d %.1f h%d" stroke="#ddd"/><text x="%d" y="%.1f" text-anchor="end">%s</text>'
                   % (self.left, self.y(value), self.width, self.left - 6, self.y(value) + 4, text))
        yield '<rect x="%d" y="%d" width="%d" height="%d" fill="none" stroke="#555"/>' % (
            self.left, self.top, self.width, self.height)
        if title:
            yield '<text x="%d" y="%d" font-weight="bold">%s</text>' % (self.left, self.top - 8, title)
        if self.x_axis.label:
            yield '<text x="%d" y="%d" text-anchor="middle">%s</text>' % (
                self.left + self.width // 2, bottom + 36, self.x_axis.label)
        if self.y_axis.label:
            across, middle = self.left - 48, self.top + self.height // 2
            yield '<text x="%d" y="%d" transform="rotate(-90 %d %d)" text-anchor="middle">%s</text>' % (
                across, middle, across, middle, self.y_axis.label)

    def curve(self, xs, ys, colour, width=1.5, closed=False, dash=""):
        points = " ".join("%.1f,%.1f" % (self.x(x), self.y(y)) for x, y in zip(xs, ys))
        self.svg.append('<%s points="%s" fill="none" stroke="%s" stroke-width="%g"%s/>' % (
            "polygon" if closed else "polyline", points, colour, width,
            ' stroke-dasharray="%s"' % dash if dash else ""))

    def mark(self, x, y, error=0.0, fill=BLACK):
        """A point with its error bar."""
        if error:
            self.curve([x, x], [y - error, y + error], BLACK, 1.2)
        self.svg.append('<circle cx="%.1f" cy="%.1f" r="4" fill="%s" stroke="%s"/>' % (self.x(x), self.y(y), fill, BLACK))

    def box(self, x, quantiles, colour, half=9, shift=0.0):
        """Whiskers, quartiles and median of five quantiles, `shift` pixels beside x."""
        middle = self.x(x) + shift
        low, first, median, third, high = (self.y(q) for q in quantiles)
        self.svg.append('<path d="M%.1f %.1f V%.1f M%.1f %.1f V%.1f" stroke="%s"/>' % (
            middle, low, first, middle, third, high, colour))
        self.svg.append('<rect x="%.1f" y="%.1f" width="%d" height="%.1f" fill="%s" fill-opacity="0.3" stroke="%s"/>'
                        % (middle - half, third, 2 * half, max(first - third, 0.5), colour, colour))
        self.svg.append('<path d="M%.1f %.1f h%d" stroke="%s" stroke-width="2.5"/>' % (
            middle - half, median, 2 * half, colour))


def legend(entries, left, y, step):
    """Strokes with (colour, name)."""
    return ['<path d="M%d %d h30" stroke="%s" stroke-width="2.5"/><text x="%d" y="%d">%s</text>' % (
        left + step * i, y, colour, left + 36 + step * i, y + 4, name)
        for i, (colour, name) in enumerate(entries)]


def document(width, height, title, parts):
    """The drawing; parts are panels or lines of SVG."""
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" width="%d" height="%d" '
           'font-family="sans-serif" font-size="13">' % (width, height, width, height),
           "<title>%s</title>" % title, '<rect width="%d" height="%d" fill="#ffffff"/>' % (width, height)]
    for part in parts:
        out += part.svg if isinstance(part, Panel) else [part]
    return "\n".join(out + ["</svg>"]) + "\n"
