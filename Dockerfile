# The package built on a bare Debian 12, and its demo: docker build -t spring_workbench . && docker run spring_workbench
# scripts/bare_root runs the same lines without Docker.
FROM debian:bookworm
COPY . /spring_workbench
WORKDIR /spring_workbench
RUN scripts/install_dependencies
RUN scripts/build demo
CMD ["scripts/demo"]
