"""Draws the pictures of this example: a round face, on layers of the same size (needs Pillow)."""

from collections.abc import Callable
from pathlib import Path

from PIL import Image, ImageDraw

SIZE, DRAWN = 320, 4 * 320
"""Sides of the pictures and of the drawings, pixels: scaling them down makes edges smooth."""

FACES = Path(__file__).parent / "faces"

SKIN, SHADE, INK, LIPS, WHITE = "#f2c9a0", "#d9a97c", "#40302a", "#a8443c", "#fdfaf5"

Draw = ImageDraw.ImageDraw


def save(name: str, draw: Callable[[Draw], None]) -> None:
    """Save a picture with a transparent background, drawn on a plane of 100 by 100."""
    picture = Image.new("RGBA", (DRAWN, DRAWN))
    draw(ImageDraw.Draw(picture))
    picture.resize((SIZE, SIZE), Image.Resampling.BOX).save(FACES / name, optimize=True)


def box(x: float, y: float, width: float, height: float) -> tuple[float, float, float, float]:
    """The corners of a box around a point."""
    scale = DRAWN / 100
    return (
        (x - width / 2) * scale,
        (y - height / 2) * scale,
        (x + width / 2) * scale,
        (y + height / 2) * scale,
    )


def head(draw: Draw) -> None:
    """The head with open eyes and without a mouth."""
    draw.rounded_rectangle(box(50, 92, 30, 40), 60, fill=SHADE)
    draw.ellipse(box(50, 48, 74, 84), fill=SKIN)
    draw.pieslice(box(50, 40, 78, 76), 180, 360, fill=INK)
    draw.ellipse(box(50, 45, 62, 36), fill=SKIN)
    for side in (-1, 1):
        draw.ellipse(box(50 + side * 15, 47, 15, 10), fill=WHITE)
        draw.ellipse(box(50 + side * 15, 47, 8, 8), fill=INK)
    draw_brows(draw, 0)
    draw.arc(box(50, 55, 8, 14), 20, 160, fill=SHADE, width=14)


def brows(raised: float) -> Callable[[Draw], None]:
    """Raised brows, which cover those of the head."""

    def draw(draw: Draw) -> None:
        for side in (-1, 1):
            draw.arc(box(50 + side * 15, 42, 23, 14), 195, 345, fill=SKIN, width=80)
        draw_brows(draw, raised)

    return draw


def draw_brows(draw: Draw, raised: float) -> None:
    """Draw brows above the eyes."""
    for side in (-1, 1):
        draw.arc(box(50 + side * 15, 42 - raised, 20, 12), 205, 335, fill=INK, width=26)


def blink(draw: Draw) -> None:
    """The head with closed eyes."""
    head(draw)
    for side in (-1, 1):
        draw.ellipse(box(50 + side * 15, 47, 17, 11), fill=SKIN)
        draw.arc(box(50 + side * 15, 45, 15, 10), 20, 160, fill=INK, width=18)


def mouth(width: float, height: float) -> Callable[[Draw], None]:
    """A mouth that is open by a height, 0 for a closed one."""

    def draw(draw: Draw) -> None:
        draw.ellipse(box(50, 71, width + 5, height + 5), fill=SKIN)
        draw.ellipse(box(50, 71, width, max(height, 2)), fill=LIPS)
        if height > 6:
            draw.ellipse(box(50, 71, width - 6, height - 5), fill=INK)

    return draw


def smile(draw: Draw) -> None:
    """A mouth that smiles."""
    draw.ellipse(box(50, 71, 30, 12), fill=SKIN)
    draw.chord(box(50, 66, 30, 24), 15, 165, fill=LIPS)


if __name__ == "__main__":
    save("head.png", head)
    save("brows-1.png", brows(1.5))
    save("brows-2.png", brows(3))
    save("blink.png", blink)
    save("rest.png", mouth(18, 2))
    save("smile.png", smile)
    for number, (width, height) in enumerate([(19, 5), (17, 11), (21, 8), (13, 7)]):
        save(f"speak-{number}.png", mouth(width, height))
