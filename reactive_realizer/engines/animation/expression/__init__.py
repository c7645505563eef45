"""The formula language of procedural animations: text is parsed to a tree, and compiled to one Python function."""
