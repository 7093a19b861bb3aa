mod banded;
mod contact;
mod hidden;
mod involute;
mod passage;
mod ring;
mod wear;
mod checks;

fn main() {
    checks::main();
}
