# Placeholder until the front door is built.
