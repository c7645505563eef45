"""Taking the turn when the other has finished (thesis, examples 8 and 17).

A user asks something, and hesitates on the way. The anticipator `user` gets what a voice detector and a recognizer
tell, and predicts the end of the turn; a nod hangs on it, and the answer a little after it. The planner sends its block
once, while the user still speaks, and does nothing more.

Look at when the answer is expected: unknown while the voice sounds, soon in the pause, sooner after words that can end
a sentence, and later after those that want another.
"""

import asyncio

from stage import Stage, open_stage

REPLY = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="reply">
  <gaze id="listening" target="viewer" start="0" end="words:end"/>
  <head id="nod" lexeme="NOD" start="anticipators:user:stop"/>
  <speech id="words" start="anticipators:user:stop+0.2"><text>Down the stairs, and then to the left.</text></speech>
</bml>
"""
HEARD = [
    (0.2, "voice", 1.0, None),
    (1.9, "voice", 0.0, None),
    (2.1, "words", None, "I would like to know the"),
    (2.7, "voice", 1.0, None),
    (4.3, "voice", 0.0, None),
    (4.4, "words", None, "I would like to know the way to the trains."),
]


def expected(stage: Stage) -> str:
    """What the planner was told last of the start of the answer."""
    *_, reply = stage.feedback.predictions("reply")[-1].element
    start = reply.get("start")
    return "not expected yet" if start is None else f"expected at {float(start):.2f}"


async def main() -> Stage:
    async with open_stage("reply:nod:start", "reply:words:*") as stage:
        stage.perform(REPLY)
        for time, name, value, text in HEARD:
            await stage.until(time)
            stage.event("user", name, value, text)
            await stage.tick()
            what = f'understood "{text}"' if text else f"voice {'on' if value else 'off'}"
            stage.tell(f"{what}: the answer is {expected(stage)}", time)
        await stage.until(10)
        return stage


if __name__ == "__main__":
    asyncio.run(main())
