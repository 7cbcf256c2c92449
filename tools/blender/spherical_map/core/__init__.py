"""What the add-on computes and whom it asks, without Blender: arrays in, arrays out."""
