"""The shared world that people see, point in and talk through."""
