"""What a living figure does when it does nothing."""
