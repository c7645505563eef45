"""Starting a block that was planned ahead. The room knows its name, and neither the block nor how it starts."""
