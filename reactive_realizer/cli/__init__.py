"""The command line: the only package that prints, and that defines exit statuses."""
