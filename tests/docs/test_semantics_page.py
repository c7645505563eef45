"""docs/semantics.md shows all transitions of a block."""

from reactive_realizer.scheduler.block_state import TRANSITIONS

from .conftest import page


def test_the_page_shows_every_transition_of_a_block_and_no_other() -> None:
    table = page("docs/semantics.md").partition("| from | event |")[2].partition("\n\n")[0]
    shown = [[cell.strip() for cell in row.split("|")[1:-1]] for row in table.splitlines()[2:]]
    assert shown == [
        [
            ", ".join(state.value for state in row.sources),
            row.event.value,
            row.target.value,
            row.writes,
            ", ".join(row.pins),
            ", ".join(row.reports),
        ]
        for row in TRANSITIONS
    ]
