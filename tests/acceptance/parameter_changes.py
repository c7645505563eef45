"""What tests of changing parameters write, and read."""

from typing import Any

from reactive_realizer.testing.pilot import RealizerPilot

SPEECH = '<speech id="s"><text>Let me <sync id="m"/>tell you all about it, for it is a long story.</text></speech>'
HEAD = '<head id="h" lexeme="NOD" repetition="4" start="0" end="4" amount="{}"/>'


def change(
    id_: str, syncs: str, *, target: str = "b:s", parameter: str = "volume", space: str = "bmla", **trajectory: Any
) -> str:
    """A parametervaluechange: linear, to 100, unless said otherwise."""
    said = {"type": "linear", "targetValue": 100} | trajectory
    way = " ".join(f'{name}="{value}"' for name, value in said.items())
    return (
        f'<{space}:parametervaluechange id="{id_}" target="{target}" paramId="{parameter}" {syncs}>'
        f"<{space}:trajectory {way}/></{space}:parametervaluechange>"
    )


def points(pilot: RealizerPilot, behavior: str) -> list[tuple[str, float]]:
    lines = (line for line in pilot.feedback.of("syncPointProgress") if line.id.startswith(f"{behavior}:"))
    return [(line.id.removeprefix(f"{behavior}:"), line.global_time) for line in lines]
